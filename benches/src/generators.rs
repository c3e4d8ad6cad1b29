//! Code that other generators wrote, from a shared library: see `generators/` beside the manifest.
//!
//! The library is C, compiled for this processor; each function has the shape `int name(const double *given, double *found)`, or the same with
//! `float` and a name that ends in `_f32`.

use std::sync::OnceLock;

use libloading::Library;
use linkage_runtime::Vector2;

use crate::harness::Competitor;
use crate::items::{Case, Results, Scalar, Start, Turn};

static LIBRARY: OnceLock<Library> = OnceLock::new();

/// The methods: the beginnings of their functions' names, and what the tables call them.
const METHODS: [(&str, &str); 4] = [
    ("casadi_hand", "CasADi, eliminated by hand"),
    ("casadi_symbolic", "CasADi, its symbolic QR"),
    ("casadi_qr", "CasADi, its sparse QR"),
    ("sympy", "SymPy, linsolve and cse"),
];

/// How many numbers the functions of an item are given and find, as `generate.py` writes them.
const SHAPES: [(&str, usize, usize); 6] =
    [("P1a", 11, 9), ("P1b", 5, 9), ("P1c", 5, 1), ("P1d", 5, 18), ("P2b", 5, 15), ("P3b", 3, 9)];

/// A scalar that the library has functions for.
pub(crate) trait Foreign: Scalar {
    /// How their names end.
    const ENDING: &str;
    fn nearest(number: f64) -> Self;
}

impl Foreign for f64 {
    const ENDING: &str = "";
    fn nearest(number: f64) -> Self {
        number
    }
}

impl Foreign for f32 {
    const ENDING: &str = "_f32";
    #[allow(clippy::cast_possible_truncation, reason = "to single precision")]
    fn nearest(number: f64) -> Self {
        number as Self
    }
}

/// Loads the library, from which all items take competitors from then on.
pub(crate) fn load(file: &str) -> Result<(), String> {
    #[allow(unsafe_code, reason = "the library is what the generators wrote, and has no initialisers")]
    let library = unsafe { Library::new(file) }.map_err(|error| format!("{file}: {error}"))?;
    LIBRARY.set(library).map_err(|_| "a library is loaded already".to_owned())
}

/// A function of the library, by how many numbers it is given and finds.
pub(crate) struct Function<T, const GIVEN: usize, const FOUND: usize>(unsafe extern "C" fn(*const T, *mut T) -> i32);

impl<T, const GIVEN: usize, const FOUND: usize> Clone for Function<T, GIVEN, FOUND> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T, const GIVEN: usize, const FOUND: usize> Copy for Function<T, GIVEN, FOUND> {}

impl<T: Foreign, const GIVEN: usize, const FOUND: usize> Function<T, GIVEN, FOUND> {
    /// The function of this name.
    fn named(name: &str) -> Self {
        let name = format!("{name}{}", T::ENDING);
        let library = LIBRARY.get().expect("a library is loaded");
        #[allow(unsafe_code, reason = "all functions of the library have this type, by how their names end")]
        let function = unsafe { library.get(name.as_bytes()) };
        Self(*function.unwrap_or_else(|error| panic!("{name}: {error}")))
    }

    /// Calls it.
    #[inline]
    pub(crate) fn find(self, given: &[T; GIVEN], found: &mut [T; FOUND]) -> bool {
        #[allow(unsafe_code, reason = "it reads and writes as many numbers as the arrays have, and keeps nothing")]
        let status = unsafe { (self.0)(given.as_ptr(), found.as_mut_ptr()) };
        status == 0
    }
}

/// The functions for an item, each with what the tables call its method; none if no library is loaded.
pub(crate) fn functions<T: Foreign, const GIVEN: usize, const FOUND: usize>(
    item: &str,
) -> Vec<(&'static str, Function<T, GIVEN, FOUND>)> {
    if LIBRARY.get().is_none() {
        return Vec::new();
    }
    let item = item.trim_end_matches("-f32");
    assert!(SHAPES.contains(&(item, GIVEN, FOUND)), "{item} is not given {GIVEN} numbers, or does not find {FOUND}");
    let item = item.to_lowercase();
    METHODS.iter().map(|(prefix, method)| (*method, Function::named(&format!("{prefix}_{item}")))).collect()
}

/// A function of the library, and what it is given: a pose or the driver's angle, and the loads.
#[derive(Clone, Copy)]
struct Call<T, const GIVEN: usize, const FOUND: usize> {
    function: Function<T, GIVEN, FOUND>,
    given: [T; GIVEN],
}

impl<T: Foreign, const GIVEN: usize, const FOUND: usize> Start for Call<T, GIVEN, FOUND> {
    fn depend(&mut self, change: f64) -> bool {
        // Of the loads, as with all others, where a pose is given; it is the longest of what is given.
        let which = if GIVEN > LONGEST { GIVEN - 1 } else { 0 };
        self.given[which] = T::nearest(self.given[which].into() + change);
        true
    }
}

/// What is given at most beside a pose: an angle, and two forces.
const LONGEST: usize = 5;

/// What is found: for each set of loads the forces as x, y, then the torque.
#[derive(Clone, Copy)]
struct Found<T, const N: usize, const PARTS: usize>([T; N]);

impl<T: Foreign, const N: usize, const PARTS: usize> Default for Found<T, N, PARTS> {
    fn default() -> Self {
        Self([T::default(); N])
    }
}

impl<T: Foreign, const N: usize, const PARTS: usize> Results for Found<T, N, PARTS> {
    const MISTAKE: f64 = <T as Scalar>::MISTAKE;
    fn parts(&self) -> Vec<(f64, Vec<Vector2<f64>>)> {
        let part = |numbers: &[T]| {
            let (torque, forces) = numbers.split_last().expect("a torque");
            let force = |force: &[T]| Vector2::new(force[0].into(), force[1].into());
            ((*torque).into(), forces.chunks_exact(2).map(force).collect())
        };
        self.0.chunks_exact(N / PARTS).map(part).collect()
    }
    fn last(&self) -> f64 {
        self.0[N - 1].into() + self.0[N / PARTS - 1].into()
    }
}

/// Adds the library's functions for an item, if one is loaded; `given` lays out the first of an argument: the angle, or a pose.
///
/// `GIVEN` numbers are given, `N` found, for `PARTS` sets of loads.
pub(crate) fn add<T: Foreign, L: crate::items::Loads, const GIVEN: usize, const N: usize, const PARTS: usize>(
    competitors: &mut Vec<Competitor>,
    item: &str,
    turn: &Turn<L>,
    loads: fn(&L) -> Vec<Vector2<f64>>,
) {
    for (method, function) in functions::<T, GIVEN, N>(item) {
        let prepare = |case: &Case<f64, L>| {
            let mut given = vec![T::nearest(case.start)];
            if GIVEN > LONGEST {
                given = posed(given[0]);
            }
            given.extend(loads(&case.loads).iter().flat_map(|force| [force.x, force.y]).map(T::nearest));
            let Ok(given) = given.try_into() else { unreachable!("as many numbers as the function is given") };
            Case { start: Call { function, given }, loads: case.loads }
        };
        competitors.push(turn.posed(method, prepare, |case, found: &mut Found<T, N, PARTS>| {
            case.start.function.find(&case.start.given, &mut found.0)
        }));
    }
}

/// The four-bar's pose as the library's functions have it.
fn posed<T: Foreign>(theta: T) -> Vec<T> {
    let mut pose = [T::default(); 7];
    assert!(Function::named("casadi_pose").find(&[theta], &mut pose), "a pose");
    pose.to_vec()
}
