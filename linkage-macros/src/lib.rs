//! The procedural macro `linkage!`.
