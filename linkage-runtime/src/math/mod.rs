//! Elementary functions with the same bits on every target.
//!
//! Only `+ − × ÷`, the square root, comparisons, integer operations and bit casts, in the order written: no library of
//! the platform, and no fused multiply-add but in the functions that are named for it, where it is IEEE 754's. The same
//! source therefore gives the same bits on a microcontroller without a floating-point unit, on a desktop and in a browser,
//! at every optimisation level. Nothing panics, nothing allocates, and [`f32`](mod@f32) never touches an `f64`, but in
//! the routine of the compiler that stands for a fused operation where the processor has none.
//!
//! | function | largest error found, `f64` and `f32` | promised |
//! |---|---|---|
//! | `sqrt` | | correctly rounded |
//! | `sin_cos`, `sin_cos_half` | 0.887, 0.788 ulp (every `f32`) | 0.95 ulp |
//! | `fused_sin_cos`, `fused_sin_cos_half` | 0.950, 0.914 ulp (every `f32`) | 0.96 ulp |
//! | `sin_cos_sum` | 0.83, 0.83 ulp | 0.95 ulp + ε²·max(4, \|x\|) |
//! | `fused_sin_cos_sum` | 0.926, 0.923 ulp | 0.96 ulp + ε²·max(4, \|x\|) |
//! | `atan2` | 0.66, 0.67 ulp | 0.70 ulp |
//! | `unit` | norm 0.99, 1.13 ε; component 1.18, 1.46 ε | 1.5 ε for both |
//! | `polar` | 0.92, 1.03 ε of a component | 1.3 ε |
//!
//! ε is 2⁻⁵² (`f64`) or 2⁻²³ (`f32`), an ulp the distance of neighbouring numbers at the true result. An argument that
//! is not finite gives NaN in every result; the infinite square root alone is infinite.

/// `c0 + z·(c1 + z·(c2 + …))`, evaluated from the innermost bracket.
macro_rules! horner {
    ($z:expr; $c:expr) => { $c };
    ($z:expr; $c:expr, $($rest:expr),+) => { $c + $z * horner!($z; $($rest),+) };
}

#[macro_use]
mod sines;

#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
#[macro_use]
mod halves;

mod atan2;
pub mod f32;
pub mod f64;
mod fused;
mod plain;
mod sqrt;
mod vector;
