//! The product that is added without being rounded: `fusedMultiplyAdd` of IEEE 754, the same bits everywhere. Fast where the processor has it
//! and the program is compiled for that; elsewhere it is put together from many operations.

#[cfg(not(feature = "std"))]
mod foreign {
    #![allow(unsafe_code, reason = "`core` has no fused operation; both functions are total and free of side effects")]

    unsafe extern "C" {
        pub(super) safe fn fma(a: f64, b: f64, c: f64) -> f64;
        pub(super) safe fn fmaf(a: f32, b: f32, c: f32) -> f32;
    }
}

/// a·b + c, rounded once.
#[inline]
#[must_use]
pub fn mul_add(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(feature = "std")]
    return a.mul_add(b, c);
    #[cfg(not(feature = "std"))]
    return foreign::fma(a, b, c);
}

/// a·b + c, rounded once.
#[inline]
#[must_use]
pub fn mul_addf(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(feature = "std")]
    return a.mul_add(b, c);
    #[cfg(not(feature = "std"))]
    return foreign::fmaf(a, b, c);
}
