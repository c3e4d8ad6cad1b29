//! Sine and cosine in the two halves of a register, see `halves`.
#![allow(
    unsafe_code,
    reason = "calls of functions that name their instructions, a load of what a register holds, a barrier to the compiler"
)]

use core::arch::x86_64::{
    __m128 as Register, _mm_add_ps as add, _mm_and_ps as and, _mm_andnot_ps as andnot, _mm_cvtss_f32 as first,
    _mm_load_ps as load, _mm_mul_ps as mul, _mm_or_ps as or, _mm_set1_ps as spread, _mm_shuffle_ps, _mm_sub_ps as sub,
    _mm_xor_ps as xor,
};
#[cfg(target_feature = "fma")]
use core::arch::x86_64::{_mm_fmadd_ps as fmadd, _mm_fnmadd_ps as fnmadd};

halves!(f32, u32, 3);

#[inline]
#[target_feature(enable = "sse2")]
fn exchanged(halves: Register) -> Register {
    _mm_shuffle_ps::<0b10_11_00_01>(halves, halves)
}

#[inline]
#[target_feature(enable = "sse2")]
fn polynomial(z: Register, [c0, c1, c2]: [Register; 3]) -> Register {
    add(c0, mul(z, add(c1, mul(z, c2))))
}

#[cfg(target_feature = "fma")]
#[inline]
#[target_feature(enable = "sse2,fma")]
fn fused_polynomial(z: Register, [c0, c1, c2]: [Register; 3]) -> Register {
    fmadd(z, fmadd(z, c2, c1), c0)
}
