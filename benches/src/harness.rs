//! Takes times: the competitors of an item in turn, round after round, and each compared with the expert of the same
//! round, so that a change of the processor's speed meets all of them alike.

use std::hint::black_box;
use std::time::{Duration, Instant};

use crate::items::{Errors, Item, Results};

/// An argument that can be made to depend on the result of the call before.
pub(crate) trait Chained: Copy + 'static {
    /// Adds a number, which is zero, to what the function needs first.
    fn depend(&mut self, change: f64);
}

/// How the calls of a competitor follow each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Mode {
    /// As fast as they come: the processor works at several at once.
    Independent,
    /// Each waits for the result of the one before.
    Chained,
    /// The loop alone, without the work.
    Empty,
}

/// One way to the results of an item.
pub(crate) struct Competitor {
    /// What the printed tables call it.
    pub(crate) method: &'static str,
    /// Its largest errors over the poses that are judged.
    pub(crate) errors: Errors,
    /// The largest difference of its results from the expert's that is taken for rounding, by the largest number of all results: a torque
    /// may vanish beside forces that do not.
    rounding: f64,
    calls: Box<dyn Calls>,
}

/// A table of arguments and a function, whatever their types.
trait Calls {
    /// Goes through the table that often. Results are written to one of the places.
    fn sweep(&mut self, times: u32, mode: Mode, place: usize);
    /// The results for every argument of the table.
    fn results(&self) -> Vec<Vec<f64>>;
    /// The length of the table.
    fn length(&self) -> u32;
    /// How much memory the table takes.
    #[cfg(test)]
    fn bytes(&self) -> usize;
}

/// The function is a pointer that the optimiser cannot see through: no competitor is inlined into the loop.
struct Table<C, R> {
    cases: Vec<C>,
    /// Where results are written, all over a page of memory.
    places: Vec<R>,
    call: fn(&C, &mut R) -> bool,
}

/// A processor may tell addresses apart by their place in a page before it knows all of them. A constant with the place of the results of the
/// call before is taken for these and waits for them: at some places that slows a competitor down, at most it does not.
const PAGE: usize = 4096;

impl<C: Chained, R: Results> Calls for Table<C, R> {
    fn sweep(&mut self, times: u32, mode: Mode, place: usize) {
        let call = black_box(if mode == Mode::Empty { |_: &C, _: &mut R| true } else { self.call });
        let zero = black_box(0.0);
        let place = place % self.places.len();
        let results = &mut self.places[place];
        let mut answers = true;
        for _ in 0..times {
            if mode == Mode::Chained {
                for case in &mut self.cases {
                    case.depend(zero * results.last());
                    answers &= call(case, black_box(results));
                }
            } else {
                for case in &self.cases {
                    answers &= call(case, black_box(results));
                }
            }
        }
        assert!(black_box(answers), "a pose without an answer");
    }

    fn results(&self) -> Vec<Vec<f64>> {
        let result = |case| {
            let mut results = R::default();
            assert!((self.call)(case, &mut results), "a pose without an answer");
            results.numbers()
        };
        self.cases.iter().map(result).collect()
    }

    fn length(&self) -> u32 {
        u32::try_from(self.cases.len()).expect("a short table")
    }

    #[cfg(test)]
    fn bytes(&self) -> usize {
        size_of_val(self.cases.as_slice())
    }
}

impl Competitor {
    /// A function and the table of its arguments.
    pub(crate) fn new<C: Chained, R: Results>(
        method: &'static str,
        errors: Errors,
        cases: Vec<C>,
        call: fn(&C, &mut R) -> bool,
    ) -> Self {
        let places = vec![R::default(); PAGE.div_ceil(size_of::<R>())];
        Self { method, errors, rounding: R::MISTAKE, calls: Box::new(Table { cases, places, call }) }
    }

    /// Goes through the table that often.
    pub(crate) fn sweep(&mut self, times: u32, mode: Mode) {
        self.calls.sweep(times, mode, 0);
    }

    /// How much memory its table of arguments takes.
    #[cfg(test)]
    pub(crate) fn bytes(&self) -> usize {
        self.calls.bytes()
    }

    fn time(&mut self, sweeps: u32, mode: Mode, place: usize) -> Duration {
        let start = Instant::now();
        self.calls.sweep(sweeps, mode, place);
        start.elapsed()
    }

    /// As many sweeps as take the time.
    fn sweeps_for(&mut self, least: Duration, mode: Mode) -> u32 {
        let mut sweeps = 1;
        while self.time(sweeps, mode, 0) < least && sweeps < 1 << 20 {
            sweeps *= 2;
        }
        sweeps
    }
}

/// Whether all competitors of an item give the expert's results for all arguments that are timed.
///
/// Errors are found over other poses, with other loads: this is what says that the same work is timed.
pub(crate) fn agree(item: &Item) -> Result<(), String> {
    let (expert, others) = item.competitors.split_first().ok_or("an item without competitors")?;
    let expected = expert.calls.results();
    let largest = expected.iter().flatten().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    for other in others {
        for (index, (result, expected)) in other.calls.results().iter().zip(&expected).enumerate() {
            if !result.iter().zip(expected).all(|(x, y)| (x - y).abs() <= other.rounding * largest) {
                return Err(format!("{}: {} disagrees with the expert at pose {index}", item.id, other.method));
            }
        }
    }
    Ok(())
}

/// A competitor's time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    /// Median of the times of a call.
    pub(crate) nanoseconds: f64,
    /// Median of the ratios to the expert of the same round.
    pub(crate) ratio: f64,
    /// The quarter of the rounds with the smallest ratios ends here, that with the largest begins there.
    pub(crate) quartiles: (f64, f64),
}

/// Times all competitors of an item: A B C A B C …, with results at another place in each round.
pub(crate) fn measure(item: &mut Item, rounds: usize, least: Duration, mode: Mode) -> Vec<Timing> {
    let sweeps: Vec<u32> = item.competitors.iter_mut().map(|competitor| competitor.sweeps_for(least, mode)).collect();
    let mut times = vec![Vec::with_capacity(rounds); item.competitors.len()];
    for round in 0..rounds {
        for ((competitor, sweeps), times) in item.competitors.iter_mut().zip(&sweeps).zip(&mut times) {
            let calls = f64::from(*sweeps) * f64::from(competitor.calls.length());
            times.push(competitor.time(*sweeps, mode, round).as_secs_f64() * 1e9 / calls);
        }
    }
    times.iter().map(|own| timing(own, &times[0])).collect()
}

/// What the times of a competitor's rounds come to, beside those of the expert in the same rounds.
fn timing(times: &[f64], expert: &[f64]) -> Timing {
    let [low, ratio, high] = quartiles(times.iter().zip(expert).map(|(time, expert)| time / expert).collect());
    let [_, nanoseconds, _] = quartiles(times.to_vec());
    Timing { nanoseconds, ratio, quartiles: (low, high) }
}

/// The values a quarter, half and three quarters of the way up; exactly those if there is one more than a multiple of
/// four.
fn quartiles(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    [1, 2, 3].map(|quarter| values[(values.len() - 1) * quarter / 4])
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "small whole numbers are exact")]
mod tests {
    use super::*;

    #[test]
    fn quartiles_do_not_depend_on_order_or_outliers() {
        assert_eq!(quartiles(vec![5.0, 1.0, 4.0, 2.0, 3.0]), [2.0, 3.0, 4.0]);
        assert_eq!(quartiles(vec![5e9, 1.0, 4.0, 2.0, 3.0]), [2.0, 3.0, 4.0]);
        assert_eq!(quartiles(vec![7.0]), [7.0; 3]);
    }

    /// The machine becomes ten times slower in the middle: the paired ratios do not notice.
    #[test]
    fn ratios_are_of_the_same_round() {
        let expert = [1.0, 1.0, 10.0, 10.0, 10.0];
        let double = expert.map(|time| 2.0 * time);
        let Timing { nanoseconds, ratio, quartiles } = timing(&double, &expert);
        assert_eq!((nanoseconds, ratio, quartiles), (20.0, 2.0, (2.0, 2.0)));
    }

    impl Chained for f64 {
        fn depend(&mut self, change: f64) {
            *self += change;
        }
    }

    /// An item whose second competitor is off by a relative difference.
    fn item(second: fn(&f64, &mut f64) -> bool) -> Item {
        let cases = || vec![1.0, 2.0, 3.0];
        let first = |x: &f64, out: &mut f64| {
            *out = 2.0 * x;
            true
        };
        let competitors = vec![
            Competitor::new("first", Errors::default(), cases(), first),
            Competitor::new("second", Errors::default(), cases(), second),
        ];
        Item { id: "T", title: "a test", competitors }
    }

    #[test]
    fn those_that_disagree_are_found() {
        let same = item(|x, out| {
            *out = x + x * (1.0 + 1e-12);
            true
        });
        assert_eq!(agree(&same), Ok(()));
        let other = item(|x, out| {
            *out = if *x < 3.0 { 2.0 * x } else { 6.001 };
            true
        });
        assert_eq!(agree(&other), Err("T: second disagrees with the expert at pose 2".into()));
        let not_a_number = item(|_, out| {
            *out = f64::NAN;
            true
        });
        assert!(agree(&not_a_number).is_err());
    }

    #[test]
    fn every_mode_comes_to_an_end() {
        let mut item = item(|x, out| {
            *out = x + x;
            true
        });
        for mode in [Mode::Independent, Mode::Chained, Mode::Empty] {
            let timings = measure(&mut item, 5, Duration::from_micros(10), mode);
            assert_eq!(timings.len(), 2);
            assert_eq!(timings[0].ratio, 1.0);
        }
    }
}
