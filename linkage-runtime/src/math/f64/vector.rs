//! Directions and vectors of given length.

use super::super::vector::vectors;
use super::{sin_cos, sqrt};

vectors!(f64, u64);
