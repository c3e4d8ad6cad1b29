//! Sweeps by blocks of positions, several of which the processor computes at once.
//!
//! A position is computed without a branch: all results, and whether all checks hold. Loops over the positions of a block are then
//! straight-line code, which the compiler turns into vector instructions; each of their operations is rounded as the scalar one is, so
//! that the results have the same bits. Where a check fails, the function for a single position solves the whole block, one by one, and
//! says why.

/// The functions for a scalar; `$bits` are as many as it has.
macro_rules! lanes {
    ($scalar:ident, $bits:ident) => {
        /// How many positions a block has.
        pub const BLOCK: usize = 64;

        /// Of the last block, positions up to a multiple of this are computed: no instruction computes more at once.
        const STEP: usize = 64 / size_of::<$scalar>();

        /// How many positions are computed of a block that ends behind so many.
        #[inline(always)]
        fn computed(lanes: usize) -> usize {
            lanes.next_multiple_of(STEP).min(BLOCK)
        }

        /// How many checks have failed. A sum, as such a loop becomes vector instructions whatever is checked; by numbers of the scalar's
        /// size, so that a register counts as many positions as it computes.
        pub type Count = $bits;

        /// One for a check that fails, zero for one that holds.
        #[inline(always)]
        #[must_use]
        pub fn failed(holds: bool) -> Count {
            Count::from(!holds)
        }

        /// A number at each position of a block.
        pub type Column = [$scalar; BLOCK];

        /// Positions that are computed at once. One piece of memory: the compiler sees that columns do not overlap. It begins with a line of
        /// the cache, so that no register is read out of two.
        #[derive(Debug)]
        #[repr(align(64))]
        pub struct Block<const GIVEN: usize, const KEPT: usize, const RESULTS: usize> {
            /// What the scene reads.
            pub given: [Column; GIVEN],
            /// What a stage of the computation leaves for later ones.
            pub kept: [Column; KEPT],
            /// What the scene finds; later stages read it too.
            pub results: [Column; RESULTS],
        }

        /// A sweep of a scene that reads `GIVEN` numbers, has `RESULTS` numbers, and keeps `KEPT` between its stages.
        pub trait Lanes<const GIVEN: usize, const KEPT: usize, const RESULTS: usize> {
            /// Lays out what is given from a position on; behind the last one its values once more, up to a whole register.
            fn give(&self, first: usize, given: &mut [Column; GIVEN]);

            /// The first positions of a block, as many as are asked for: whether all checks hold. Otherwise the results mean nothing.
            fn solve(&self, block: &mut Block<GIVEN, KEPT, RESULTS>, lanes: usize) -> bool;

            /// Takes the first results of the block that begins at a position.
            fn take(&mut self, first: usize, lanes: usize, results: &[Column; RESULTS]);

            /// Solves a single position.
            fn point(&mut self, index: usize) -> Result<(), crate::Error>;
        }

        /// Solves one position after the other, up to the first without an answer.
        #[cfg(not(feature = "std"))]
        #[inline]
        pub fn sweep<const GIVEN: usize, const KEPT: usize, const RESULTS: usize>(
            count: usize,
            sweep: &mut impl Lanes<GIVEN, KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            crate::sweep::sweep(count, |index| sweep.point(index))
        }

        /// Solves blocks of positions by the widest instructions that the processor has, up to the first position without an answer.
        #[cfg(feature = "std")]
        pub fn sweep<const GIVEN: usize, const KEPT: usize, const RESULTS: usize>(
            count: usize,
            sweep: &mut impl Lanes<GIVEN, KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            crate::processor::instructions().dispatch(Blocks { count, sweep })
        }

        /// All blocks of a sweep.
        #[cfg(feature = "std")]
        struct Blocks<'a, S, const GIVEN: usize, const KEPT: usize, const RESULTS: usize> {
            count: usize,
            sweep: &'a mut S,
        }

        #[cfg(feature = "std")]
        impl<S: Lanes<GIVEN, KEPT, RESULTS>, const GIVEN: usize, const KEPT: usize, const RESULTS: usize> pulp::WithSimd
            for Blocks<'_, S, GIVEN, KEPT, RESULTS>
        {
            type Output = Result<(), crate::SweepError>;

            #[inline(always)]
            fn with_simd<I: pulp::Simd>(self, _: I) -> Self::Output {
                let Self { count, sweep } = self;
                let empty = [0.0; BLOCK];
                let mut block = Block { given: [empty; GIVEN], kept: [empty; KEPT], results: [empty; RESULTS] };
                for first in (0..count).step_by(BLOCK) {
                    sweep.give(first, &mut block.given);
                    let lanes = BLOCK.min(count - first);
                    if sweep.solve(&mut block, computed(lanes)) {
                        sweep.take(first, lanes, &block.results);
                    } else {
                        one_by_one(first..first + lanes, sweep)?;
                    }
                }
                Ok(())
            }
        }

        /// Positions among which a check fails: there the function for a single position has the last word.
        #[cfg(feature = "std")]
        #[cold]
        #[inline(never)]
        fn one_by_one<const GIVEN: usize, const KEPT: usize, const RESULTS: usize>(
            positions: core::ops::Range<usize>,
            sweep: &mut impl Lanes<GIVEN, KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            for index in positions {
                sweep.point(index).map_err(|error| crate::SweepError::Position { index, error })?;
            }
            Ok(())
        }

        /// Lays out the parts of a series, each in a column of its own. What is the same everywhere stays where it is after the first
        /// block.
        #[inline(always)]
        pub fn lay<T: Copy, const PARTS: usize>(
            series: &crate::Series<'_, T>,
            first: usize,
            mut columns: [&mut Column; PARTS],
            parts: impl Fn(T) -> [$scalar; PARTS],
        ) {
            match series {
                crate::Series::Constant(value) => {
                    if first == 0 {
                        columns.into_iter().zip(parts(*value)).for_each(|(column, part)| column.fill(part));
                    }
                }
                crate::Series::Each(values) => {
                    let values = values.get(first..).unwrap_or_default();
                    // A whole block has a length that the compiler knows.
                    match (values.first_chunk::<BLOCK>(), columns.as_mut_slice()) {
                        // All is read before anything is written: the compiler need not know that the values lie elsewhere.
                        (Some(values), [column]) => **column = values.map(|value| parts(value)[0]),
                        (Some(values), _) => lay_each(values, &mut columns, parts),
                        (None, _) => lay_each(values, &mut columns, parts),
                    }
                }
            }
        }

        /// Lays out the parts of values, as far as a block has room for them, and of the last one once more behind it, up to a whole
        /// register: what is computed there counts for the checks.
        #[inline(always)]
        fn lay_each<T: Copy, const PARTS: usize>(
            values: &[T],
            columns: &mut [&mut Column; PARTS],
            parts: impl Fn(T) -> [$scalar; PARTS],
        ) {
            for lane in 0..computed(values.len()) {
                let Some(value) = values.get(lane).or(values.last()) else { return };
                let parts = parts(*value);
                for which in 0..PARTS {
                    columns[which][lane] = parts[which];
                }
            }
        }

        /// Copies the results of so many positions to where they go.
        #[inline(always)]
        pub fn put(to: &mut [$scalar], first: usize, lanes: usize, column: &Column) {
            let to = to.get_mut(first..).unwrap_or_default();
            if let (BLOCK, Some(to)) = (lanes, to.first_chunk_mut::<BLOCK>()) {
                *to = *column;
            } else if let (Some(to), Some(from)) = (to.get_mut(..lanes), column.get(..lanes)) {
                to.copy_from_slice(from);
            }
        }
    };
}
pub(crate) use lanes;

#[cfg(all(test, feature = "std"))]
mod tests {
    use crate::__private::f64::{BLOCK, Block, Column, Count, Lanes, failed, lay, put, sweep};
    use crate::{Error, Series};

    /// Two blocks, and one more.
    const COUNT: usize = 2 * BLOCK + 1;

    /// The reciprocals of some numbers.
    struct Reciprocals<'a> {
        of: &'a [f64],
        results: &'a mut [f64],
    }

    impl Lanes<1, 0, 1> for Reciprocals<'_> {
        fn give(&self, first: usize, [column]: &mut [Column; 1]) {
            lay(&Series::Each(self.of), first, [column], |value| [value]);
        }

        fn solve(&self, block: &mut Block<1, 0, 1>, lanes: usize) -> bool {
            let mut count: Count = 0;
            for lane in 0..lanes {
                let given = block.given[0][lane];
                block.results[0][lane] = 1.0 / given;
                count += failed(given != 0.0);
            }
            count == 0
        }

        fn take(&mut self, first: usize, lanes: usize, [column]: &[Column; 1]) {
            put(self.results, first, lanes, column);
        }

        fn point(&mut self, index: usize) -> Result<(), Error> {
            if self.of[index] == 0.0 {
                return Err(Error::NotFinite { what: "a reciprocal" });
            }
            self.results[index] = -1.0;
            Ok(())
        }
    }

    /// What is computed behind the last position, up to a whole register, is no position: its checks hold if those of the last one do.
    #[test]
    fn no_block_is_solved_one_by_one_for_what_is_behind_its_end() {
        for count in 0..=COUNT {
            let (of, mut results) = ([2.0; COUNT], [0.0; COUNT]);
            let (of, results) = (&of[..count], &mut results[..count]);
            sweep(count, &mut Reciprocals { of, results }).expect("none is zero");
            assert_eq!(results, &[0.5; COUNT][..count]);
        }
    }

    #[test]
    fn a_block_in_which_a_check_fails_is_solved_one_by_one_up_to_there() {
        for zero in [0, 5, BLOCK - 1, BLOCK, 2 * BLOCK] {
            let (mut of, mut results) = ([2.0; COUNT], [0.0; COUNT]);
            of[zero] = 0.0;
            sweep(of.len(), &mut Reciprocals { of: &of, results: &mut results }).expect_err("one is zero");
            let begin = zero / BLOCK * BLOCK;
            let parts = [&results[..begin], &results[begin..zero], &results[zero..]];
            for (part, expected) in parts.into_iter().zip([0.5, -1.0, 0.0]) {
                assert_eq!(part, &[expected; COUNT][..part.len()]);
            }
        }
    }
}
