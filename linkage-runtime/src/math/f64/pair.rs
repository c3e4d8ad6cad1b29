//! Sine and cosine in the two halves of a register, see `halves`.
#![allow(
    unsafe_code,
    reason = "calls of functions that name their instructions, a load of what a register holds, a barrier to the compiler"
)]

use core::arch::x86_64::{
    __m128d as Register, _mm_add_pd as add, _mm_and_pd as and, _mm_andnot_pd as andnot, _mm_cvtsd_f64 as first,
    _mm_load_pd as load, _mm_mul_pd as mul, _mm_or_pd as or, _mm_set1_pd as spread, _mm_shuffle_pd, _mm_sub_pd as sub,
    _mm_xor_pd as xor,
};
#[cfg(target_feature = "fma")]
use core::arch::x86_64::{_mm_fmadd_pd as fmadd, _mm_fnmadd_pd as fnmadd};

halves!(f64, u64, 6);

#[inline]
#[target_feature(enable = "sse2")]
fn exchanged(halves: Register) -> Register {
    _mm_shuffle_pd::<1>(halves, halves)
}

/// In pairs (Estrin 1960).
#[inline]
#[target_feature(enable = "sse2")]
fn polynomial(z: Register, [c0, c1, c2, c3, c4, c5]: [Register; 6]) -> Register {
    let z2 = mul(z, z);
    let (low, middle, high) = (add(c0, mul(z, c1)), add(c2, mul(z, c3)), add(c4, mul(z, c5)));
    add(add(low, mul(z2, middle)), mul(mul(z2, z2), high))
}

#[cfg(target_feature = "fma")]
#[inline]
#[target_feature(enable = "sse2,fma")]
fn fused_polynomial(z: Register, [c0, c1, c2, c3, c4, c5]: [Register; 6]) -> Register {
    let z2 = mul(z, z);
    let (low, middle, high) = (fmadd(z, c1, c0), fmadd(z, c3, c2), fmadd(z, c5, c4));
    fmadd(z2, fmadd(z2, high, middle), low)
}
