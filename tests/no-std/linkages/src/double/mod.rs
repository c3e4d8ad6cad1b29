//! Linkages in double precision.

pub mod adjustable;
pub mod four_bar;
pub mod six_bar;

crate::digest::scalar!(f64);
