//! Newton's method along the motion of the drives.

/// The functions for a scalar.
///
/// Slices are walked by patterns: neither an index nor an iterator, which keep a way to panic in unoptimised builds.
macro_rules! search {
    ($scalar:ident) => {
        /// Where the drives are while the places of a group are looked for.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Way<const K: usize> {
            /// Where they are wanted.
            Wanted,
            /// Between there and the pose from which the search begins.
            Between([$scalar; K]),
        }

        /// The unknowns of a group: directions, and travels.
        type Places<const D: usize, const T: usize> = ([($scalar, $scalar); D], [$scalar; T]);

        /// Newton's method along the motion of the drives, from a closed pose to where they are wanted, so that the search stays on its
        /// branch.
        ///
        /// The drives go straight, by strides; after each the group is closed by Newton's method. A stride is in doubt, taken back and
        /// halved, unless
        ///
        /// * the first step turns no link by more than [`BOUND`](Self::BOUND),
        /// * each step is at most a quarter of the one before: a rate at which Newton's method has one solution to go to, by the theorem
        ///   of Newton and Kantorovich as if the equations were as curved everywhere as on that way, until nothing but rounding is
        ///   left of it,
        /// * it leaves less open than before, and the determinant of the Jacobian keeps its sign: no singular pose lies between.
        ///
        /// Where strides vanish, there is a pose from which the motion does not go on. If the drives are where they began, the start
        /// is taken to be rough: all there is to do is to close the group, by bounded steps of which those that gain nothing are halved.
        ///
        /// D. Deuflhard, Newton Methods for Nonlinear Problems, 2004, sections 2.1 and 5.1.
        pub struct Search<const D: usize, const T: usize, const N: usize, const K: usize> {
            from: [$scalar; K],
            to: [$scalar; K],
            /// How long the way is, in the longest strides.
            length: $scalar,
            /// The part of the way that is behind, that of the present stride, and that to which it leads.
            behind: $scalar,
            stride: $scalar,
            ahead: $scalar,
            mode: Mode,
            strides: u32,
            /// Where the group was closed last.
            closed: Places<D, T>,
            best: Places<D, T>,
            next: Places<D, T>,
            scales: [$scalar; T],
            step: [$scalar; N],
            /// The lengths of the first step of a stride, of the second one, and of the last one.
            first: $scalar,
            second: $scalar,
            last: $scalar,
            /// What is open at the best place, negative before the first evaluation; what was open at first; what rounding may leave.
            open: $scalar,
            begin: $scalar,
            rounding: $scalar,
            /// The sign of the determinant; NaN before it is known.
            sense: $scalar,
            evaluations: u32,
            arrived: bool,
        }

        impl<const D: usize, const T: usize, const N: usize, const K: usize> Search<D, T, N, K> {
            /// Strides until it gives up.
            const STRIDES: u32 = 1024;
            /// Evaluations in a stride.
            const EVALUATIONS: u32 = 40;
            /// The longest step.
            pub const BOUND: $scalar = 0.5;
            /// A step that is as short as this is no longer in doubt: about the root of the smallest difference of numbers.
            const SHORT: $scalar = if $scalar::EPSILON < 1e-10 { 1.0 / 67_108_864.0 } else { 1.0 / 2048.0 };

            /// Before the first evaluation. `reach` is how far each drive goes in the longest stride.
            #[must_use]
            pub fn new(
                (directions, travels): Places<D, T>,
                from: [$scalar; K],
                to: [$scalar; K],
                reach: [$scalar; K],
            ) -> Self {
                let mut length = 0.0;
                let mut rest = (from.as_slice(), to.as_slice(), reach.as_slice());
                while let ([a, from @ ..], [b, to @ ..], [reach, reaches @ ..]) = rest {
                    length += (*b - *a).abs() / *reach;
                    rest = (from, to, reaches);
                }
                let start = (directions, travels);
                let mut search = Self {
                    from,
                    to,
                    length,
                    behind: 0.0,
                    stride: if length > 1.0 { 1.0 / length } else { 1.0 },
                    ahead: 0.0,
                    mode: Mode::Begins,
                    strides: Self::STRIDES,
                    closed: start,
                    best: start,
                    next: start,
                    scales: [0.0; T],
                    step: [0.0; N],
                    first: 0.0,
                    second: 0.0,
                    last: 0.0,
                    open: -1.0,
                    begin: 0.0,
                    rounding: 0.0,
                    sense: $scalar::NAN,
                    evaluations: 0,
                    arrived: false,
                };
                if length > 1024.0 {
                    search.strides = 0;
                }
                search
            }

            /// Whether it goes on, and where the drives are then.
            pub fn way(&mut self) -> Option<Way<K>> {
                match self.mode {
                    Mode::Begins => self.mode = if self.length > 0.0 { Mode::Walks } else { Mode::Closes },
                    Mode::Walks if !self.arrived => {
                        self.stride *= 0.5;
                        // A sense that was seen too far from the start need not be that of the start.
                        if self.behind <= 0.0 {
                            self.sense = $scalar::NAN;
                        }
                    }
                    Mode::Walks if self.ahead < 1.0 => {
                        (self.closed, self.behind) = (self.best, self.ahead);
                        if self.second <= 0.0625 * self.first {
                            self.stride *= 2.0;
                        }
                        if self.stride * self.length > 1.0 {
                            self.stride = 1.0 / self.length;
                        }
                    }
                    Mode::Walks | Mode::Closes | Mode::GivesUp => return None,
                }
                self.ahead = self.behind + self.stride;
                if matches!(self.mode, Mode::Walks) && (self.strides == 0 || self.ahead <= self.behind) {
                    // What stays open where the drives are wanted, for the message.
                    self.mode = Mode::GivesUp;
                }
                self.strides = self.strides.wrapping_sub(1);
                (self.best, self.step, self.open, self.arrived) = (self.closed, [0.0; N], -1.0, false);
                self.evaluations = Self::EVALUATIONS;
                if !matches!(self.mode, Mode::Walks) || self.ahead >= 1.0 {
                    self.ahead = 1.0;
                    return Some(Way::Wanted);
                }
                let mut at = self.from;
                let mut rest = (at.as_mut_slice(), self.to.as_slice());
                while let ([a, others @ ..], [b, to @ ..]) = rest {
                    *a += self.ahead * (*b - *a);
                    rest = (others, to);
                }
                Some(Way::Between(at))
            }

            /// Whether it goes on there, and the places at which to evaluate: the best so far, moved by a step.
            #[inline]
            pub fn places(&mut self) -> Option<Places<D, T>> {
                if self.evaluations == 0 {
                    return None;
                }
                self.evaluations = self.evaluations.wrapping_sub(1);
                self.next = self.best;
                let (mut directions, mut steps) = (self.next.0.as_mut_slice(), self.step.as_slice());
                while let ([direction, others @ ..], [step, more @ ..]) = (directions, steps) {
                    *direction = turned(*direction, *step);
                    (directions, steps) = (others, more);
                }
                let mut rest = (self.next.1.as_mut_slice(), self.scales.as_slice(), steps);
                while let ([travel, travels @ ..], [scale, scales @ ..], [step, steps @ ..]) = rest {
                    *travel += *step * *scale;
                    rest = (travels, scales, steps);
                }
                Some(self.next)
            }

            /// Takes residuals and Jacobian there. `rounding` is what rounding may leave open of all residuals together, `scales` are the
            /// travels that count like a turn of one radian.
            #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "what is no number is in doubt")]
            pub fn evaluated(
                &mut self,
                residuals: [$scalar; N],
                jacobian: [[$scalar; N]; N],
                rounding: $scalar,
                scales: [$scalar; T],
            ) {
                let open = sum_of_sizes(&residuals);
                let factors = Factors::of(jacobian, magnitudes(jacobian));
                let (solution, sense) = (factors.solve(residuals), factors.distance());
                let longest = largest(&solution);
                let (begins, walks) = (self.open < 0.0, matches!(self.mode, Mode::Walks));
                if begins {
                    (self.begin, self.first) = (open, longest);
                    if !walks || self.sense.is_nan() {
                        self.sense = sense;
                    }
                } else if self.evaluations.wrapping_add(2) == Self::EVALUATIONS {
                    self.second = longest;
                }
                let same_sense = sense * self.sense > 0.0;
                if begins || open < self.open && same_sense {
                    let most = if begins { Self::BOUND } else { 0.25 * self.last };
                    let contracts = longest <= most || longest <= Self::SHORT || open <= rounding;
                    (self.best, self.open, self.rounding, self.scales) = (self.next, open, rounding, scales);
                    (self.step, self.last) = (solution, longest);
                    self.scale(-(if longest > Self::BOUND { Self::BOUND / longest } else { 1.0 }));
                    if walks && !(same_sense && contracts) {
                        self.evaluations = 0;
                        return;
                    }
                    self.arrived = open <= rounding;
                    if walks && self.ahead < 1.0 && longest <= 0.0625 * self.first {
                        // Closed well enough to go on from there.
                        (self.arrived, self.evaluations) = (true, 0);
                    }
                    return;
                }
                if self.arrived || walks && !(self.last <= Self::SHORT) {
                    self.evaluations = 0;
                }
                self.scale(0.5);
            }

            fn scale(&mut self, factor: $scalar) {
                let mut rest = self.step.as_mut_slice();
                while let [value, others @ ..] = rest {
                    *value *= factor;
                    rest = others;
                }
            }

            /// What stays open where the drives are wanted, zero if the group is closed there and the way leads to it; and the places.
            #[must_use]
            pub fn found(&self) -> ($scalar, [($scalar, $scalar); D], [$scalar; T]) {
                let is_closed = self.open <= self.rounding;
                // What closes without a way to it is open all the same.
                let open = match self.mode {
                    Mode::GivesUp if is_closed && self.begin > self.rounding => self.begin,
                    Mode::GivesUp if is_closed => self.rounding + $scalar::MIN_POSITIVE,
                    _ if is_closed => 0.0,
                    _ => self.open,
                };
                (open, self.best.0, self.best.1)
            }
        }

        /// What a search does.
        #[derive(Clone, Copy)]
        enum Mode {
            Begins,
            /// Closes the group where it is.
            Closes,
            /// Goes by strides.
            Walks,
            /// Sees what stays open.
            GivesUp,
        }

        /// The sum of magnitudes; NaN if one is.
        fn sum_of_sizes<const N: usize>(values: &[$scalar; N]) -> $scalar {
            let (mut sum, mut rest) = (0.0, values.as_slice());
            while let [value, others @ ..] = rest {
                sum += value.abs();
                rest = others;
            }
            sum
        }

        /// The largest magnitude; NaN if one is.
        #[allow(clippy::neg_cmp_op_on_partial_ord, reason = "a NaN is the last word")]
        fn largest<const N: usize>(values: &[$scalar; N]) -> $scalar {
            let (mut largest, mut rest) = (0.0, values.as_slice());
            while let [value, others @ ..] = rest {
                let size = value.abs();
                // Written so that a NaN is the last word.
                if !(size <= largest) && !largest.is_nan() {
                    largest = size;
                }
                rest = others;
            }
            largest
        }

        fn magnitudes<const N: usize>(mut matrix: [[$scalar; N]; N]) -> [[$scalar; N]; N] {
            let mut lines = matrix.as_mut_slice();
            while let [line, others @ ..] = lines {
                let mut values = line.as_mut_slice();
                while let [value, more @ ..] = values {
                    *value = value.abs();
                    values = more;
                }
                lines = others;
            }
            matrix
        }

        /// A direction after a step along the tangent, brought back to unit size: turned by the arc tangent of the step.
        #[inline]
        #[must_use]
        pub fn turned((cos, sin): ($scalar, $scalar), step: $scalar) -> ($scalar, $scalar) {
            unit(cos - step * sin, sin + step * cos)
        }
    };
}
pub(crate) use search;

#[cfg(test)]
mod tests {
    use crate::__private::f64::{Search, Way};

    /// The direction whose cosine is a drive, followed from a start to a wanted place; what is open, and how often it was evaluated.
    fn cosine(start: (f64, f64), from: f64, to: f64) -> ((f64, f64), f64, usize) {
        let mut search = Search::<1, 0, 1, 1>::new(([start], []), [from], [to], [0.25]);
        let mut count = 0;
        while let Some(way) = search.way() {
            let [wanted] = match way {
                Way::Wanted => [to],
                Way::Between(at) => at,
            };
            while let Some(([(cos, sin)], [])) = search.places() {
                search.evaluated([cos - wanted], [[-sin]], 1e-15, []);
                count += 1;
            }
        }
        let (open, [at], []) = search.found();
        (at, open, count)
    }

    #[test]
    fn a_rough_start_closes_where_it_is() {
        let ((_, sin), open, _) = cosine((1e-3, 1.0), 0.8, 0.8);
        assert!((sin - 0.6).abs() < 1e-15 && open.to_bits() == 0, "{sin} {open}");
        assert!(cosine((1e-3, -1.0), 0.8, 0.8).0.1 < 0.0);
        assert!(cosine((1e-3, 1.0), 1.5, 1.5).1 > 0.4);
    }

    #[test]
    fn a_search_walks_on_its_branch_to_the_edge_of_what_closes() {
        let ((_, sin), open, count) = cosine((0.0, 1.0), 0.0, 0.8);
        assert!((sin - 0.6).abs() < 1e-15 && open.to_bits() == 0 && count < 20, "{sin} {open} {count}");
        assert!((cosine((0.0, -1.0), 0.0, -0.8).0.1 + 0.6).abs() < 1e-15);
        // A hair's breadth from the limit, and beyond it.
        let near = 1.0 - 1e-10;
        let ((cos, sin), open, _) = cosine((0.0, -1.0), 0.0, near);
        assert!((cos - near).abs() < 1e-15 && sin < 0.0 && open.to_bits() == 0, "{cos} {sin} {open}");
        let (_, open, count) = cosine((0.0, 1.0), 0.0, 1.0 + 1e-9);
        assert!(open > 0.0 && open < 2e-9 && count < 500, "{open} {count}");
        assert!((cosine((0.0, 1.0), 0.0, 1.5).1 - 0.5).abs() < 1e-3);
    }

    #[test]
    fn no_way_is_no_answer() {
        for to in [1e9, f64::MAX, f64::INFINITY, f64::NAN] {
            let (_, open, count) = cosine((0.0, 1.0), 0.0, to);
            assert!((open > 0.0 || open.is_nan()) && count < 100, "{to} {open} {count}");
        }
    }
}
