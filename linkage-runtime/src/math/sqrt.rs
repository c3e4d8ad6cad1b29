//! The square root, the one operation of IEEE 754 that `core` lacks.
//!
//! It is correctly rounded by the standard, so every implementation gives the same bits. With the feature `std` it is
//! the method of the standard library; without it the symbol of C, which `compiler_builtins` provides on bare metal and
//! in WebAssembly, and which becomes one instruction where the hardware has it.

#[cfg(not(feature = "std"))]
mod foreign {
    #![allow(unsafe_code, reason = "`core` has no square root; both functions are total and free of side effects")]

    unsafe extern "C" {
        pub(super) safe fn sqrt(x: f64) -> f64;
        pub(super) safe fn sqrtf(x: f32) -> f32;
    }
}

/// √x, correctly rounded; NaN for x < 0.
#[inline]
#[must_use]
pub fn sqrt(x: f64) -> f64 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return foreign::sqrt(x);
}

/// √x, correctly rounded; NaN for x < 0.
#[inline]
#[must_use]
pub fn sqrtf(x: f32) -> f32 {
    #[cfg(feature = "std")]
    return x.sqrt();
    #[cfg(not(feature = "std"))]
    return foreign::sqrtf(x);
}
