//! The elementary functions against arbitrary-precision arithmetic.
//!
//! `f64` is measured against `dashu-float`, whose results at 200 bits are correctly rounded. `f32` is measured against
//! the `f64` functions, whose error, bounded by the tests of `f64`, is below 10⁻⁸ of an ulp of `f32`. The tests that are
//! ignored by default repeat the others with more points (`cargo test --release -- --ignored`, half an hour).

#![allow(clippy::cast_possible_truncation, reason = "rounding to f32 and taking the lower bits are meant")]
#![allow(clippy::cast_precision_loss, clippy::cast_sign_loss, reason = "random bits and small counts")]
#![allow(clippy::float_cmp, reason = "exact results are compared exactly")]

mod atan2;
mod bits;
mod bounds;
mod reference;
mod sample;
mod sin_cos_f32;
mod sin_cos_f64;
mod special;
mod vector;
