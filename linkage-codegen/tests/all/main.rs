//! The compiler's tests, in one program: what they share is compiled once, and the long ones of one file run beside those of others.

mod accuracy;
mod control;
mod emitted;
mod emitted_random;
mod error_bound;
mod families;
mod grammar;
mod inverse;
mod limits;
mod moving;
mod newton;
mod not_finite;
mod operations;
mod passes;
mod random;
mod redundant;
mod robustness;
mod rules;
mod seed;
mod sensitivities;
mod skip;
mod snapshots;
mod starts;
mod stress;
mod support;
mod unknowns;
