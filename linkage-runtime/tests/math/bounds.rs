//! The errors that the documentation promises, in ulp of the true result unless said otherwise.

/// Both results of `sin_cos`, `f64` and `f32`, for every finite angle. Next to π/4, where the tail is half an ulp of y, the roundings of the sine
/// add up to 0.944 ulp if all are the worst at once.
pub(crate) const SIN_COS: f64 = 0.95;

/// Both of `fused_sin_cos`: the roundings of the cosine add up to 0.957 ulp, 0.5 at last, 0.196 of each of the two sums before, 0.045 of the
/// product, and 0.02 for the tail, which is multiplied by y in place of sin y.
pub(crate) const FUSED_SIN_COS: f64 = 0.96;

/// The same of `sin_cos_sum` and `fused_sin_cos_sum`, after an absolute allowance of so many ε²·max(4, |x|).
pub(crate) const SUM_ALLOWANCE: f64 = 1.0;

/// `atan2`, `f64` and `f32`.
pub(crate) const ATAN2: f64 = 0.70;

/// The norm of `unit` against 1, and its components against the true ones, in ε.
pub(crate) const UNIT_NORM: f64 = 1.5;
pub(crate) const UNIT_COMPONENT: f64 = 1.5;

/// Each component of `polar`, in ε of its size.
pub(crate) const POLAR: f64 = 1.3;
