//! Linkages in single precision.

pub mod folding;
pub mod four_bar;
pub mod iterated;
pub mod press;
pub mod slider_crank;
pub mod swept;

crate::digest::scalar!(f32);
