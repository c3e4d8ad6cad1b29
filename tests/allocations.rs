//! A sweep allocates nothing: neither in blocks of positions nor one by one, nor where it stops.
#![allow(unsafe_code, reason = "an allocator that counts")]

use core::cell::Cell;
use std::alloc::{GlobalAlloc, Layout, System};

use linkage_runtime::{Series, SweepError, Vector2, linkage};

linkage! {
    /// A four-bar with inertia, whose sweep is computed in blocks.
    mod four_bar;
    ground       { A0: (0, 0), B0: (0.14m, 0) }
    link crank   { A0 -> A: 0.04m }
    link coupler { A -> B: 0.12m, C: (50mm, 30mm) }
    link rocker  { B0 -> B: 0.08m }
    mass coupler: 1.2kg at C, inertia 1900kg*mm^2;
    revolute A0: ground  -> crank;
    revolute A:  crank   -> coupler;
    revolute B:  coupler -> rocker;
    revolute B0: ground  -> rocker;
    drive theta: A0;
    assemble B: left(A -> B0);
    load I: inertia;
    load F: force(coupler.C);
    scene held: equilibrium -> (effort_theta, B);
    scene cycle: sweep(held);
}

linkage! {
    /// A triad, whose sweep is searched position by position.
    mod triad;
    units { mm, N }
    ground     { O: (0, 0), Q: (500mm, 100mm), P: (400mm, -100mm) }
    link crank { O -> A: 28mm }
    link rod   { A -> E: 230mm }
    link plate { E: (0, 0), C: (100mm, 70mm), D: (70mm, -90mm) }
    link upper { Q -> C: 192mm }
    link lower { P -> D: 180mm }
    revolute O: ground -> crank;
    revolute A: crank -> rod;
    revolute E: rod -> plate;
    revolute C: plate -> upper;
    revolute D: plate -> lower;
    revolute Q: ground -> upper;
    revolute P: ground -> lower;
    drive theta: O;
    start theta: 30deg;
    start rod: (30mm, 20mm), angle 30deg;
    start plate: (240mm, 140mm), angle 0;
    start upper: (500mm, 100mm), angle 140deg;
    start lower: (400mm, -100mm), angle 120deg;
    load M: moment(plate) = 2N*m;
    scene held: equilibrium -> (effort_theta, E);
    scene cycle: sweep(held);
}

/// The system's allocator, and how often the thread has asked it for memory.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: the system's allocator does everything; a counter of the thread, made without an allocation, is all that is added.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        // SAFETY: as it was asked for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as it was asked for.
        unsafe { System.dealloc(place, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// How often something allocates.
fn allocations(of: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    of();
    ALLOCATIONS.get() - before
}

/// Some blocks of positions and a part of one.
const COUNT: usize = 200;

#[test]
fn control_an_allocation_is_counted() {
    assert_eq!(allocations(|| drop(std::hint::black_box(vec![1.0; COUNT]))), 1);
}

#[test]
fn a_sweep_allocates_nothing() {
    let thetas: [f64; COUNT] = core::array::from_fn(|index| 0.05 * f64::from(u32::try_from(index).expect("small")));
    let rates = thetas.map(|theta| 20.0 + theta);
    let [mut effort, mut x, mut y] = [[0.0; COUNT]; 3];
    let mut swept = Ok(());
    let found = allocations(|| {
        let inputs = four_bar::CycleInputs {
            theta: Series::Each(&thetas),
            theta_rate: Series::Each(&rates),
            theta_acceleration: Series::Constant(-3.0),
            F: Series::Constant(Vector2::new(3.0, -40.0)),
        };
        swept = four_bar::cycle(&inputs, four_bar::Cycle { effort_theta: &mut effort, B_x: &mut x, B_y: &mut y });
    });
    assert_eq!((found, swept), (0, Ok(())));
    assert!(effort.iter().chain(&x).chain(&y).all(|value| *value != 0.0));
    // Nor where positions are solved one by one, nor where one has no answer.
    for (index, expected) in [(None, Ok(())), (Some(77), Err(77))] {
        let mut thetas = thetas;
        if let Some(index) = index {
            thetas[index] = f64::NAN;
        }
        let found = allocations(|| {
            let inputs = triad::CycleInputs { theta: Series::Each(&thetas) };
            swept = triad::cycle(&inputs, triad::Cycle { effort_theta: &mut effort, E_x: &mut x, E_y: &mut y });
        });
        let stopped = swept.map_err(|error| match error {
            SweepError::Position { index, .. } => index,
            _ => usize::MAX,
        });
        assert_eq!((found, stopped), (0, expected));
    }
}
