//! What the functions emitted by [`linkage!`] call at run time, and the types that they take and return.
//!
//! `no_std`, no allocation, no panic. The macro is re-exported from here: this is the only crate that a user names.
//!
//! ```
//! use linkage_runtime::{Error, Vector2, linkage, polar};
//!
//! linkage! {
//!     /// A crank-rocker with a force on its coupler.
//!     pub mod four_bar;
//!     units { mm, N }
//!
//!     ground       { A0: (0, 0), B0: (140mm, 0) }
//!     link crank   { A0 -> A: 80mm }
//!     link coupler { A -> B: 100mm, C: (50mm, 20mm) }
//!     link rocker  { B0 -> B: 120mm }
//!
//!     revolute A0: ground  -> crank;
//!     revolute A:  crank   -> coupler;
//!     revolute B:  coupler -> rocker;
//!     revolute B0: ground  -> rocker;
//!
//!     drive theta: A0;
//!     unknown T12: torque(ground -> crank);
//!     assemble B: left(A -> B0);
//!
//!     load F: force(coupler.C);
//!     scene torque: virtual_work -> (T12);
//!     scene statics: equilibrium;
//! }
//!
//! # fn main() -> Result<(), Error> {
//! let loads = four_bar::Loads { F: polar(50.0, 230f64.to_radians()) };
//! let torque = four_bar::torque_at(1.0, &loads)?.T12;
//!
//! let pose = four_bar::Pose::at(1.0)?;
//! let all = pose.statics(&loads)?;
//! assert!((all.T12 - torque).abs() < 1e-9);
//! assert!((all.B + all.A - loads.F).norm() > 0.0);
//! # Ok(())
//! # }
//! ```
#![no_std]

#[cfg(any(feature = "std", test))]
extern crate std;

mod closure;
pub mod cycle;
mod error;
mod finite;
mod lanes;
pub mod limits;
mod linear;
pub mod math;
#[cfg(feature = "std")]
mod processor;
#[cfg(feature = "reference")]
pub mod reference;
mod results;
mod search;
mod support;
mod sweep;

pub use closure::{Along, Side};
pub use error::Error;
pub use linkage_macros::linkage;
/// The plane vector of the public functions; the version of nalgebra is part of this crate's version.
pub use nalgebra::{self, Vector2};
pub use results::{GearReaction, ResolvedForce, SliderReaction, SlotReaction, WeldReaction, WorkTerm, Wrench, polar};
pub use sweep::{Series, SweepError};

/// What emitted code calls. Not for use by hand: it changes with the compiler.
#[doc(hidden)]
pub mod __private {
    #[cfg(feature = "std")]
    pub use crate::processor::limit_registers;
    #[cfg(feature = "reference")]
    pub use crate::reference::{Compared, verify};
    pub use crate::sweep::{same_length, store, sweep};

    pub mod f32 {
        pub use crate::math::f32::*;
        crate::finite::finite!(f32, u32, four_f32, 0x7F80_0000, 0x5000_0000);
        crate::lanes::lanes!(f32, u32);
        crate::limits::limits!(f32);
        crate::linear::linear!(f32);
        crate::search::search!(f32);
        crate::support::support!(f32, x => x);
    }
    pub mod f64 {
        pub use crate::math::f64::*;
        crate::finite::finite!(f64, u64, four_f64, 0x7FF0_0000, 0x5000_0000_0000_0000);
        crate::lanes::lanes!(f64, u64);
        crate::limits::limits!(f64);
        crate::linear::linear!(f64);
        crate::search::search!(f64);
        crate::support::support!(f64, x => x as f32);
    }
}

#[cfg(all(doctest, feature = "std"))]
#[doc = include_str!("../../README.md")]
struct Readme;
