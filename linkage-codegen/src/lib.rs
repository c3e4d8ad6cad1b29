//! The compiler behind `linkage!`.
