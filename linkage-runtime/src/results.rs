//! Types of results.

use nalgebra::{Scalar, Vector2};

/// A reaction along and across the x axis of a link: the method of resolution of forces.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A lever that stands at a right angle.
///     mod lever;
///     units { mm, N }
///     ground     { O: (0, 0) }
///     link lever { O -> P: 250mm }
///     revolute O: ground -> lever;
///     drive theta: O;
///     load F: force(lever.P);
///     scene held: equilibrium -> (O, O along lever);
/// }
///
/// let loads = lever::Loads { F: Vector2::new(3.0, -50.0) };
/// let held = lever::held_at(std::f64::consts::FRAC_PI_2, &loads)?;
/// // The pin pushes the lever upwards, which is along it, and to the left, which is across it.
/// assert_eq!(held.O, Vector2::new(-3.0, 50.0));
/// assert!((held.O_along_lever.axial - 50.0).abs() < 1e-14 && (held.O_along_lever.transverse - 3.0).abs() < 1e-14);
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResolvedForce<T> {
    /// Along the link's x axis.
    pub axial: T,
    /// Along that axis turned by +90°.
    pub transverse: T,
}

/// The reaction of a prismatic joint on its second link.
///
/// Along the line there is no force, as slides are smooth: `force` is `normal` times the line's direction turned by +90°.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A block on a horizontal guide, pushed down beside its middle.
///     mod press;
///     units { mm, N }
///     ground     { O: (0, 0) }
///     link block { S: (0, 0), P: (20mm, 0) }
///     prismatic S: ground.O -> block along 0deg;
///     drive x: S;
///     load F: force(block.P);
///     scene held: equilibrium;
/// }
///
/// let loads = press::Loads { F: Vector2::new(3.0, -50.0) };
/// let held = press::held_at(100.0, &loads)?;
/// assert_eq!(held.effort_x, -3.0);
/// assert_eq!((held.S.force, held.S.normal, held.S.couple), (Vector2::new(0.0, 50.0), 50.0, 1000.0));
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderReaction<T: Scalar> {
    /// The force, ground axes.
    pub force: Vector2<T>,
    /// Its signed size along the slide's direction turned by +90°.
    pub normal: T,
    /// The couple about the slide's runner, the point that is on the line, counter-clockwise.
    pub couple: T,
}

/// The reaction of a weld on its second link.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A lever with an arm welded to it at a right angle.
///     mod bell_crank;
///     units { mm, N }
///     ground     { O: (0, 0) }
///     link lever { O -> W: 100mm }
///     link arm   { W -> P: 50mm }
///     revolute O: ground -> lever;
///     weld W: lever -> arm, angle 90deg;
///     drive theta: O;
///     load F: force(arm.P);
///     scene held: equilibrium;
/// }
///
/// let loads = bell_crank::Loads { F: Vector2::new(8.0, 0.0) };
/// let held = bell_crank::held_at(0.0, &loads)?;
/// // The lever pulls the arm back, and keeps it from turning clockwise.
/// assert_eq!((held.W.force, held.W.couple, held.effort_theta), (Vector2::new(-8.0, 0.0), 400.0, 400.0));
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeldReaction<T: Scalar> {
    /// The force, ground axes.
    pub force: Vector2<T>,
    /// The couple about the weld's point, counter-clockwise.
    pub couple: T,
}

/// The reaction of a pin in a slot on its second link, whether that is the pin's or the slot's.
///
/// Along the slot there is no force, as slots are smooth: `force` is `normal` times the slot's direction turned by +90°.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A crank whose pin drives a yoke along a guide.
///     mod scotch_yoke;
///     units { mm, N }
///     ground     { O: (0, 0) }
///     link crank { O -> A: 80mm }
///     link yoke  { Y: (0, 0) }
///     revolute O: ground -> crank;
///     prismatic Y: ground.O -> yoke along 0deg;
///     slot A: crank.A -> yoke.Y along 90deg of yoke;
///     drive theta: O;
///     load F: force(yoke.Y);
///     scene held: equilibrium;
/// }
///
/// let loads = scotch_yoke::Loads { F: Vector2::new(-50.0, 0.0) };
/// let held = scotch_yoke::held_at(0.0, &loads)?;
/// // The slot points upwards, its direction turned by +90° to the left: against the force of the crank.
/// assert_eq!((held.A.force, held.A.normal), (Vector2::new(50.0, 0.0), -50.0));
/// assert_eq!(held.effort_theta, 0.0);
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotReaction<T: Scalar> {
    /// The force at the pin, ground axes.
    pub force: Vector2<T>,
    /// Its signed size along the slot's direction turned by +90°.
    pub normal: T,
}

/// The reaction of a gear pair on its second wheel, where the wheels touch.
///
/// With u the direction from the first centre to the second and t this direction turned by +90°, `force` is `tangential` times
/// `t + tan α u` on the left flank, `t − tan α u` on the right one, α being the pressure angle.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A pinion of 20 mm turns a wheel of 40 mm.
///     mod drive;
///     units { mm, N }
///     ground      { O: (0, 0), P: (60mm, 0) }
///     link pinion { O }
///     link wheel  { P }
///     revolute O: ground -> pinion;
///     revolute P: ground -> wheel;
///     gear G: pinion.O -> wheel.P, radii (20mm, 40mm), pressure_angle 45deg, flank left;
///     drive theta: O;
///     load M: moment(wheel);
///     scene held: equilibrium;
/// }
///
/// let held = drive::held_at(0.3, &drive::Loads { M: 800.0 })?;
/// // The tooth holds the wheel at its left end, upwards, and pushes it away to the right.
/// assert_eq!((held.G.tangential, held.G.force.y, held.effort_theta), (20.0, 20.0, 400.0));
/// assert!((held.G.force.x - 20.0).abs() < 1e-12);
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearReaction<T: Scalar> {
    /// The force, ground axes.
    pub force: Vector2<T>,
    /// Its signed part across the line of centres.
    pub tangential: T,
}

/// The term of a load in the principle of virtual work.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A lever of 250 mm.
///     mod lever;
///     units { mm, N }
///     ground     { O: (0, 0) }
///     link lever { O -> P: 250mm }
///     revolute O: ground -> lever;
///     drive theta: O;
///     load F: force(lever.P);
///     scene torque: virtual_work;
/// }
///
/// let loads = lever::Loads { F: Vector2::new(0.0, -8.0) };
/// let torque = lever::torque_at(0.0, &loads)?;
/// // Turned at 1 rad/s, the end moves upwards with 250 mm/s: against the force.
/// assert_eq!((torque.F.velocity, torque.F.work, torque.effort_theta), (-250.0, -2000.0, 2000.0));
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorkTerm<T> {
    /// Velocity of the load's point along the load, for unit rate; of a moment the rate of rotation that it works on. Zero for a
    /// force of zero, which has no direction.
    pub velocity: T,
    /// Load times velocity.
    pub work: T,
}

/// The resultant of forces: a force, and the moment about a point.
///
/// ```
/// use linkage_runtime::{Vector2, linkage};
///
/// linkage! {
///     /// A rotor that is out of balance.
///     mod rotor;
///     ground     { O: (0, 0), P: (2m, 0) }
///     link rotor { O -> G: 0.5m }
///     mass rotor: 3kg at G;
///     revolute O: ground -> rotor;
///     drive theta: O { rate: 10rad/s, acceleration: 0 };
///     load I: inertia;
///     scene shakes: acceleration -> (shaking(ground.P));
///     scene felt: equilibrium -> (ground about ground.P);
/// }
///
/// // Upright it pulls the ground up by m r ω², which turns clockwise about what is to the right of it.
/// let up = core::f64::consts::FRAC_PI_2;
/// let shaking = rotor::shakes_at(up)?.shaking_ground_P;
/// assert!((shaking.force - Vector2::new(0.0, 150.0)).norm() < 1e-12 && (shaking.moment + 300.0).abs() < 1e-12);
/// // As inertia is its only load, that is what the ground feels.
/// let felt = rotor::felt_at(up)?.ground_about_ground_P;
/// assert!((felt.force - shaking.force).norm() < 1e-12 && (felt.moment - shaking.moment).abs() < 1e-12);
/// # Ok::<(), linkage_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<T: Scalar> {
    /// The force, ground axes.
    pub force: Vector2<T>,
    /// The moment about the point, counter-clockwise.
    pub moment: T,
}

/// A vector by its size and its angle in radians, counter-clockwise from the x axis.
///
/// ```
/// let force = linkage_runtime::polar(50.0, 90f64.to_radians());
/// assert!((force.y - 50.0).abs() < 1e-13 && force.x.abs() < 1e-13);
/// ```
///
/// Sine and cosine are those of [`math`](crate::math). An argument that is not finite makes components that are NaN, which every
/// scene reports as [`Error::NotFinite`](crate::Error::NotFinite).
#[must_use]
pub fn polar<T: Polar>(size: T, angle: T) -> Vector2<T> {
    let (x, y) = T::polar(size, angle);
    Vector2::new(x, y)
}

/// A scalar of which [`polar`] makes vectors: `f32` or `f64`.
pub trait Polar: Sized + sealed::Sealed {
    /// `(size cos angle, size sin angle)`.
    fn polar(size: Self, angle: Self) -> (Self, Self);
}

impl Polar for f64 {
    fn polar(size: Self, angle: Self) -> (Self, Self) {
        crate::math::f64::polar(size, angle)
    }
}

impl Polar for f32 {
    fn polar(size: Self, angle: Self) -> (Self, Self) {
        crate::math::f32::polar(size, angle)
    }
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}
