//! Indices into a model's lists, one type each.

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(u32);

        impl $name {
            /// From a place in its list.
            #[must_use]
            pub fn new(index: usize) -> Self {
                Self(u32::try_from(index).unwrap_or(u32::MAX))
            }

            /// The first of its list.
            pub const FIRST: Self = Self(0);

            /// The place in its list.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// A link; the ground is the first.
    LinkId,
    /// A point of a link.
    PointId,
    /// A joint.
    JointId,
    /// A parameter.
    ParamId,
    /// A drive.
    DriveId,
    /// An unknown.
    UnknownId,
    /// A load.
    LoadId,
    /// A closure.
    ClosureId,
}

/// The fixed link.
pub const GROUND: LinkId = LinkId::FIRST;
