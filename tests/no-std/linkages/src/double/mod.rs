//! Linkages in double precision.

pub mod adjustable;
pub mod four_bar;
pub mod fused;
pub mod six_bar;
pub mod triad;
pub mod two_drives;

crate::digest::scalar!(f64);
