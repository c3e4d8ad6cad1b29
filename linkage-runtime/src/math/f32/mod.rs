//! The functions in `f32`.

mod atan2;
mod fused;
mod large;
#[cfg(all(target_arch = "x86_64", target_feature = "sse2"))]
mod pair;
mod sin_cos;
mod vector;

pub use super::fused::mul_addf as mul_add;
pub use super::sqrt::sqrtf as sqrt;
pub use atan2::atan2;
pub use fused::{
    fused_sin_cos, fused_sin_cos_half, fused_sin_cos_sum, short_fused_angle, short_fused_angle_sum, short_fused_sin_cos,
};
pub use sin_cos::{
    UNMARKED, far, is_angle, is_short, short_angle, short_angle_sum, short_sin_cos, sin_cos, sin_cos_half, sin_cos_sum,
};
pub use vector::{polar, unit};
