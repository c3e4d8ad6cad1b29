//! What is measured: work items, each with its competitors.
//!
//! All competitors of an item have functions of one shape, `fn(&Case, &mut Results) -> bool`, where the result says
//! whether there is an answer: the same arguments come in, the same numbers are written to the same place.

/// Loads of a linkage in a scalar: their names and sizes.
macro_rules! loads {
    ($linkage:ident, $scalar:ident; $($load:ident: $size:literal N),+) => {
        #[allow(clippy::cast_possible_truncation, reason = "in single precision")]
        impl crate::items::Loads for crate::linkages::$linkage::Loads {
            fn toward(first: f64, second: f64) -> Self {
                let mut directions = [first, second].into_iter().map(|direction| direction as $scalar);
                Self { $($load: linkage_runtime::polar($size, directions.next().expect("a direction"))),+ }
            }
            fn rounded(self) -> Self {
                let rounded = |x: $scalar| crate::items::rounded(x.into()) as $scalar;
                Self { $($load: self.$load.map(rounded)),+ }
            }
            fn depend(&mut self, change: f64) {
                $(self.$load.x += change as $scalar;)+
            }
        }
    };
}

/// The loads of a linkage as those of the same one in another scalar or arithmetic: the nearest numbers.
macro_rules! same_loads {
    ($given:ident, $scalar:ident, $linkage:ident; $($load:ident),+) => {
        impl From<crate::linkages::$given::Loads> for crate::linkages::$linkage::Loads {
            #[allow(clippy::cast_possible_truncation, clippy::unnecessary_cast, reason = "in whichever scalar")]
            fn from(loads: crate::linkages::$given::Loads) -> Self {
                Self { $($load: loads.$load.map(|part| part as $scalar)),+ }
            }
        }
    };
}

/// A generated function as a competitor from the driver's angle, with the loads that the linkage is given: what is made of what it finds.
macro_rules! generated_at {
    ($name:ident, $scalar:ident, $linkage:ident::$scene:ident, $given:ident, |$found:ident| $results:expr, $out:ty) => {
        pub(crate) fn $name(
            case: &crate::items::Case<$scalar, crate::linkages::$given::Loads>,
            out: &mut $out,
        ) -> bool {
            match crate::linkages::$linkage::$scene(case.start, &case.loads.into()) {
                Ok($found) => {
                    *out = $results;
                    true
                }
                Err(_) => false,
            }
        }
    };
}

/// The forces and the torque that generated functions find, each in a scalar and an arithmetic, with the loads that its linkage is given.
macro_rules! generated_statics_at {
    ($forces:literal, |$all:ident| $reactions:expr; $($name:ident: $scalar:ident, $linkage:ident, $given:ident;)+) => {$(
        generated_at!($name, $scalar, $linkage::statics_at, $given, |$all| $reactions, Reactions<$forces, $scalar>);
    )+};
}

/// The expert's function as a competitor from the driver's angle.
macro_rules! expert_at {
    ($name:ident, $scalar:ident, $linkage:ident, $forces:literal) => {
        expert_at!($name, statics, $scalar, $linkage, $forces);
    };
    ($name:ident, $call:ident, $scalar:ident, $linkage:ident, $forces:literal) => {
        pub(crate) fn $name(
            case: &crate::items::Case<$scalar, crate::linkages::$linkage::Loads>,
            out: &mut crate::items::Reactions<$forces, $scalar>,
        ) -> bool {
            crate::expert::$linkage::$call(case.start, &case.loads, out);
            true
        }
    };
}

pub(crate) mod dense;
pub(crate) mod four_bar;
pub(crate) mod single;
pub(crate) mod six_bar;
pub(crate) mod slider_crank;

use linkage_runtime::Vector2;

use crate::exact::{Big, Exact, difference, size, vector};
use crate::harness::{Chained, Competitor};

/// A torque, and the forces in the joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reactions<const N: usize, T = f64> {
    /// On the crank by the ground, N·mm.
    pub(crate) torque: T,
    /// N, on the second link of each joint.
    pub(crate) forces: [Vector2<T>; N],
}

impl<const N: usize, T: Scalar> Reactions<N, T> {
    /// Whether all numbers are finite; without a jump for each, none of which has to wait for another.
    #[inline]
    fn is_finite(&self) -> bool {
        self.forces.iter().fold(self.torque.is_finite(), |all, force| all & force.x.is_finite() & force.y.is_finite())
    }
}

impl<const N: usize, T: Scalar> Default for Reactions<N, T> {
    fn default() -> Self {
        Self { torque: T::default(), forces: [Vector2::new(T::default(), T::default()); N] }
    }
}

/// Numbers of either precision.
pub(crate) trait Scalar: nalgebra::Scalar + Copy + Default + Into<f64> {
    /// An error beyond this is a mistake and no rounding. In single precision plain formulas have two digits left next to the four-bar's
    /// change point.
    const MISTAKE: f64;
    /// Whether it is neither infinite nor NaN.
    fn is_finite(self) -> bool;
}
impl Scalar for f32 {
    const MISTAKE: f64 = 0.1;
    #[inline]
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }
}
impl Scalar for f64 {
    const MISTAKE: f64 = 1e-9;
    #[inline]
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }
}

/// The results of an item: one part for each set of loads, and what is asked of it.
pub(crate) trait Results: Copy + Default + 'static {
    /// An error beyond this is a mistake: such a competitor is not timed.
    const MISTAKE: f64;
    /// The torque and the forces of each part.
    fn parts(&self) -> Vec<(f64, Vec<Vector2<f64>>)>;
    /// A number that is there when the function has done its work.
    fn last(&self) -> f64;
    /// All numbers.
    fn numbers(&self) -> Vec<f64> {
        let part = |(torque, forces): (f64, Vec<Vector2<f64>>)| {
            forces.iter().flat_map(|force| [force.x, force.y]).chain([torque]).collect::<Vec<_>>()
        };
        self.parts().into_iter().flat_map(part).collect()
    }
}

impl<const N: usize, T: Scalar> Results for Reactions<N, T> {
    const MISTAKE: f64 = T::MISTAKE;
    fn parts(&self) -> Vec<(f64, Vec<Vector2<f64>>)> {
        vec![(self.torque.into(), self.forces.iter().map(|force| force.map(Into::into)).collect())]
    }
    fn last(&self) -> f64 {
        self.torque.into()
    }
}

impl<const N: usize, T: Scalar> Results for [Reactions<N, T>; 2] {
    const MISTAKE: f64 = T::MISTAKE;
    fn parts(&self) -> Vec<(f64, Vec<Vector2<f64>>)> {
        self.iter().flat_map(Results::parts).collect()
    }
    fn last(&self) -> f64 {
        self[0].last() + self[1].last()
    }
}

impl<T: Scalar> Results for T {
    const MISTAKE: f64 = T::MISTAKE;
    fn parts(&self) -> Vec<(f64, Vec<Vector2<f64>>)> {
        vec![((*self).into(), Vec::new())]
    }
    fn last(&self) -> f64 {
        (*self).into()
    }
}

/// The largest relative errors; a force's by the largest force of its pose, a torque's by that force at the crank's
/// length.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Errors {
    /// `None` where no force is asked for.
    pub(crate) force: Option<f64>,
    /// Zero where nothing is judged.
    pub(crate) torque: f64,
}

/// Loads of a linkage: two vectors, or one.
pub(crate) trait Loads: Copy + 'static {
    /// Loads of 50 N and 100 N in given directions.
    fn toward(first: f64, second: f64) -> Self;
    /// The nearest that single precision holds.
    #[must_use]
    fn rounded(self) -> Self;
    /// Makes a load depend on a number.
    fn depend(&mut self, change: f64);
}

/// The nearest number that single precision holds.
#[allow(clippy::cast_possible_truncation, reason = "that is the point")]
pub(crate) fn rounded(x: f64) -> f64 {
    f64::from(x as f32)
}

/// What a function starts from, beside the loads: the driver's angle, or a pose.
pub(crate) trait Start: Copy + 'static {
    /// Makes the angle depend on a number; a pose stays as it is.
    fn depend(&mut self, change: f64) -> bool;
}

#[allow(clippy::cast_possible_truncation, reason = "in single precision")]
impl Start for f32 {
    fn depend(&mut self, change: f64) -> bool {
        *self += change as f32;
        true
    }
}

impl Start for f64 {
    fn depend(&mut self, change: f64) -> bool {
        *self += change;
        true
    }
}

/// The argument of a competitor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case<S, L> {
    /// The driver's angle, or a pose.
    pub(crate) start: S,
    /// The loads that are given at run time.
    pub(crate) loads: L,
}

impl<S: Start, L: Loads> Chained for Case<S, L> {
    fn depend(&mut self, change: f64) {
        if !self.start.depend(change) {
            self.loads.depend(change);
        }
    }
}

/// All poses of a linkage, in which its items are timed and judged.
pub(crate) struct Turn<L> {
    /// Whose time is taken.
    timed: Vec<Case<f64, L>>,
    /// Whose errors are looked at, with the exact solution of each set of loads.
    judged: Vec<(Case<f64, L>, Vec<Exact>)>,
    /// The length of the crank, mm.
    arm: f64,
}

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// Whose time is taken, in a turn.
    pub(crate) timed: u32,
    /// Whether errors are looked at, in half degrees round the turn.
    pub(crate) judged: bool,
    /// The poses in disorder instead of along the turn.
    pub(crate) shuffled: bool,
    /// Angles and loads that single precision holds.
    pub(crate) single: bool,
}

impl Extent {
    /// Along the turn a pose at every two degrees, as few as the first level of a processor's cache has room for with all that is kept of them: what
    /// is timed is the work, not how fast poses are read. In disorder more, so that no processor remembers all their branches.
    pub(crate) fn judged(shuffled: bool) -> Self {
        Self { timed: if shuffled { 1024 } else { 180 }, judged: true, shuffled, single: false }
    }
}

impl<L: Loads> Turn<L> {
    /// A turn of a crank that is `arm` long; `exact` solves a pose for each set of loads.
    fn new(extent: Extent, arm: f64, exact: fn(&Big, &L) -> Vec<Exact>) -> Self {
        let mut random = Random(20_240_901);
        let full = std::f64::consts::TAU;
        let given = |start: f64, loads: L| {
            if extent.single { Case { start: rounded(start), loads: loads.rounded() } } else { Case { start, loads } }
        };
        let mut timed: Vec<_> = (0..extent.timed)
            .map(|k| {
                let theta = full * (f64::from(k) + 0.25) / f64::from(extent.timed);
                given(theta, L::toward(full * random.next(), full * random.next()))
            })
            .collect();
        if extent.shuffled {
            for k in (1..timed.len()).rev() {
                timed.swap(k, random.below(k + 1));
            }
        }
        // At 180° the four-bar folds: nothing holds its loads there.
        let half_degrees = (0_u32..720).filter(|k| extent.judged && *k != 360);
        let judged = half_degrees.map(|k| {
            let theta = (0.5 * f64::from(k)).to_radians();
            let case = given(theta, L::toward(230_f64.to_radians(), 200_f64.to_radians()));
            (case, exact(&Big::of(case.start), &case.loads))
        });
        Self { timed, judged: judged.collect(), arm }
    }

    /// A competitor that starts from the driver's angle.
    fn competitor<R: Results>(&self, method: &'static str, call: fn(&Case<f64, L>, &mut R) -> bool) -> Competitor {
        self.prepared(method, |theta| theta, call)
    }

    /// A competitor that starts from what `prepare` makes of the driver's angle, which is not timed.
    fn prepared<S: Start, R: Results>(
        &self,
        method: &'static str,
        prepare: impl Fn(f64) -> S,
        call: fn(&Case<S, L>, &mut R) -> bool,
    ) -> Competitor {
        self.posed(method, |case| Case { start: prepare(case.start), loads: case.loads }, call)
    }

    /// A competitor that is given what `case` makes of a pose, which is not timed.
    pub(crate) fn posed<S: Start, K: Loads, R: Results>(
        &self,
        method: &'static str,
        case: impl Fn(&Case<f64, L>) -> Case<S, K>,
        call: fn(&Case<S, K>, &mut R) -> bool,
    ) -> Competitor {
        let errors = self.errors(method, |given, results| call(&case(given), results));
        Competitor::new(method, errors, self.timed.iter().map(case).collect(), call)
    }

    /// The largest errors over the poses that are judged.
    fn errors<R: Results>(&self, method: &str, call: impl Fn(&Case<f64, L>, &mut R) -> bool) -> Errors {
        let mut errors = Errors::default();
        for (case, exact) in &self.judged {
            let mut results = R::default();
            assert!(call(case, &mut results), "{method} has no answer at {}", case.start);
            for ((torque, forces), exact) in results.parts().into_iter().zip(exact) {
                let largest = exact.forces.iter().map(size).reduce(Big::larger).expect("a force");
                let error = (Big::of(torque) - &exact.torque).abs() / (&largest * Big::of(self.arm));
                errors.torque = errors.torque.max(error.to_f64());
                for (force, exact) in forces.iter().zip(&exact.forces) {
                    let error = size(&difference(&vector(force.x, force.y), exact)) / &largest;
                    errors.force = Some(errors.force.unwrap_or(0.0).max(error.to_f64()));
                }
            }
        }
        let largest = errors.torque.max(errors.force.unwrap_or(0.0));
        assert!(largest < R::MISTAKE, "{method} is wrong by {largest:e}");
        errors
    }
}

/// A work item: the expert is the first of its competitors.
pub(crate) struct Item {
    /// What it is called on the command line.
    pub(crate) id: &'static str,
    /// What is to be found, from what.
    pub(crate) title: &'static str,
    /// Those that find it.
    pub(crate) competitors: Vec<Competitor>,
}

/// All items.
pub(crate) fn all(extent: Extent) -> Vec<Item> {
    let mut items = four_bar::items(extent);
    items.extend(six_bar::items(extent));
    items.extend(slider_crank::items(extent));
    items.extend(single::items(extent));
    items
}

/// The items of these ids, all where none is named.
pub(crate) fn chosen(extent: Extent, ids: &[&str]) -> Result<Vec<Item>, String> {
    let mut items = all(extent);
    if let Some(id) = ids.iter().find(|id| !items.iter().any(|item| item.id == **id)) {
        let known: Vec<&str> = items.iter().map(|item| item.id).collect();
        return Err(format!("no item is called {id}; there are {}", known.join(", ")));
    }
    items.retain(|item| ids.is_empty() || ids.contains(&item.id));
    Ok(items)
}

/// Numbers without a pattern, the same in every run (splitmix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// From 0 to 1.
    #[allow(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub(crate) fn next(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// An index below a length.
    #[allow(clippy::cast_possible_truncation, reason = "the remainder is below a length")]
    fn below(&mut self, length: usize) -> usize {
        (self.bits() % length as u64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::harness::agree;

    /// What is promised of generated code over a whole turn, the neighbours of the change point included.
    const GENERATED: f64 = 2e-15;

    /// The same of each load's part by its own largest force, which is small where the moment of the load vanishes. Next to the change point
    /// the load on the coupler passes A at 3.3 mm, C being 70 mm away: roundings of the coupler's direction count 21 times there. Room
    /// for two of them.
    const PARTS: f64 = 5e-15;

    /// The worst error of a force from the driver's angle, as the README says: rounded up to one digit.
    const WORST_SEEN: f64 = 7e-16;

    /// In single precision.
    const SINGLE: f64 = 1e-6;

    /// The same of each load's part: two roundings of 2⁻²⁴ that count 21 times.
    const SINGLE_PARTS: f64 = 2.6e-6;

    /// A closed form in plain steps loses digits near the change point, and nowhere else.
    const EXPERT: f64 = 1e-11;

    /// Elimination with exchange of rows.
    const ELIMINATION: f64 = 1e-13;

    /// In single precision.
    const SINGLE_ELIMINATION: f64 = 5e-5;

    #[test]
    fn every_competitor_is_right() {
        for item in all(Extent { timed: 1, judged: true, shuffled: false, single: false }) {
            for Competitor { method, errors, .. } in &item.competitors {
                let bar = match *method {
                    // Digits that are left next to the change point, and all.
                    method if method.starts_with("expert") && item.id.ends_with("f32") => <f32 as Scalar>::MISTAKE,
                    method if method.starts_with("LU") && item.id.ends_with("f32") => SINGLE_ELIMINATION,
                    _ if item.id == "P1d-f32" => SINGLE_PARTS,
                    _ if item.id.ends_with("f32") => SINGLE,
                    method if method.starts_with("expert") => EXPERT,
                    method if method.starts_with("LU") => ELIMINATION,
                    _ if item.id == "P1d" => PARTS,
                    _ => GENERATED,
                };
                let largest = errors.torque.max(errors.force.unwrap_or(0.0));
                assert!(largest > 0.0 && largest <= bar, "{}: {method} is off by {largest:e}", item.id);
                if (item.id, *method) == ("P1b", "generated") {
                    let force = errors.force.expect("forces");
                    assert!(force <= WORST_SEEN && force > WORST_SEEN - 1e-16, "{force:e}");
                }
            }
        }
    }

    /// Of a cache of 32 KiB, the smallest first level of its kind, the places of the results take a page.
    #[test]
    fn the_poses_that_are_timed_lie_in_the_first_level_of_the_cache() {
        for item in all(Extent { judged: false, ..Extent::judged(false) }) {
            for competitor in &item.competitors {
                let bytes = competitor.bytes();
                assert!(bytes <= 28 << 10, "{}: {bytes} bytes of {}", item.id, competitor.method);
            }
        }
    }

    #[test]
    fn all_competitors_find_the_same() {
        for item in all(Extent { timed: 720, judged: false, shuffled: true, single: false }) {
            assert_eq!(agree(&item), Ok(()));
        }
    }
}
