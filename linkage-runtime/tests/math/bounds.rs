//! The errors that the documentation promises, in ulp of the true result unless said otherwise.

/// Both results of `sin_cos` and `fused_sin_cos`, `f64` and `f32`, for every finite angle. Next to π/4, where the tail is half an ulp of y, the
/// roundings of the sine add up to 0.944 ulp if all are the worst at once, those of the fused cosine to 0.94.
pub(crate) const SIN_COS: f64 = 0.95;

/// The same of `sin_cos_sum` and `fused_sin_cos_sum`, after an absolute allowance of so many ε²·max(4, |x|).
pub(crate) const SUM_ALLOWANCE: f64 = 1.0;

/// `atan2`, `f64` and `f32`.
pub(crate) const ATAN2: f64 = 0.70;

/// The norm of `unit` against 1, and its components against the true ones, in ε.
pub(crate) const UNIT_NORM: f64 = 1.5;
pub(crate) const UNIT_COMPONENT: f64 = 1.5;

/// Each component of `polar`, in ε of its size.
pub(crate) const POLAR: f64 = 1.3;
