//! Sweeps by blocks of positions, several of which the processor computes at once.
//!
//! A position is computed without a branch: all results, and whether all checks hold. Loops over the positions of a block are then
//! straight-line code, which the compiler turns into vector instructions; each of their operations is rounded as the scalar one is, so
//! that the results have the same bits. Where a check fails, the function for a single position says why.

/// The functions for a scalar.
macro_rules! lanes {
    ($scalar:ident) => {
        /// How many positions a block has.
        pub const BLOCK: usize = 64;

        /// Of the last block, positions up to a multiple of this are computed: no instruction computes more at once.
        #[cfg(feature = "std")]
        const STEP: usize = 64 / size_of::<$scalar>();

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
            /// Positive where all checks hold. Elsewhere the numbers mean nothing.
            pub holds: Column,
        }

        /// A sweep of a scene that reads `GIVEN` numbers, has `RESULTS` numbers, and keeps `KEPT` between its stages.
        pub trait Lanes<const GIVEN: usize, const KEPT: usize, const RESULTS: usize> {
            /// The first positions of a block, as many as are asked for.
            fn solve(&self, block: &mut Block<GIVEN, KEPT, RESULTS>, lanes: usize);

            /// Lays out what is given from a position on, as far as there is something.
            fn give(&self, first: usize, given: &mut [Column; GIVEN]);

            /// Takes the results of some lanes of the block that begins at a position.
            fn take(&mut self, first: usize, lanes: core::ops::Range<usize>, results: &[Column; RESULTS]);

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
                let mut block =
                    Block { given: [empty; GIVEN], kept: [empty; KEPT], results: [empty; RESULTS], holds: empty };
                for first in (0..count).step_by(BLOCK) {
                    sweep.give(first, &mut block.given);
                    let lanes = BLOCK.min(count - first);
                    sweep.solve(&mut block, lanes.next_multiple_of(STEP));
                    // Without an early end, so that many are looked at at once.
                    if block.holds.iter().take(lanes).fold(true, |all, holds| all & (*holds > 0.0)) {
                        sweep.take(first, 0..lanes, &block.results);
                    } else {
                        one_by_one(first, lanes, sweep, &block)?;
                    }
                }
                Ok(())
            }
        }

        /// A block in which checks fail: there the function for a single position has the last word.
        #[cfg(feature = "std")]
        #[cold]
        #[inline(never)]
        fn one_by_one<const GIVEN: usize, const KEPT: usize, const RESULTS: usize>(
            first: usize,
            lanes: usize,
            sweep: &mut impl Lanes<GIVEN, KEPT, RESULTS>,
            block: &Block<GIVEN, KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            let mut from = 0;
            while from < lanes {
                let right = block.holds.iter().take(lanes).skip(from).take_while(|holds| **holds > 0.0).count();
                sweep.take(first, from..from + right, &block.results);
                from += right;
                if from < lanes {
                    let index = first + from;
                    sweep.point(index).map_err(|error| crate::SweepError::Position { index, error })?;
                    from += 1;
                }
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

        /// Lays out the parts of values, as far as a block has room for them.
        #[inline(always)]
        fn lay_each<T: Copy, const PARTS: usize>(
            values: &[T],
            columns: &mut [&mut Column; PARTS],
            parts: impl Fn(T) -> [$scalar; PARTS],
        ) {
            for (lane, value) in values.iter().enumerate().take(BLOCK) {
                let parts = parts(*value);
                for which in 0..PARTS {
                    columns[which][lane] = parts[which];
                }
            }
        }

        /// Copies some lanes of the block that begins at a position to where results go.
        #[inline(always)]
        pub fn put(to: &mut [$scalar], first: usize, lanes: core::ops::Range<usize>, column: &Column) {
            if let Some(to) = to.get_mut(first..).and_then(|to| to.first_chunk_mut::<BLOCK>())
                && lanes == (0..BLOCK)
            {
                *to = *column;
                return;
            }
            let places = first.wrapping_add(lanes.start)..first.wrapping_add(lanes.end);
            if let (Some(to), Some(from)) = (to.get_mut(places), column.get(lanes)) {
                if to.len() == from.len() {
                    to.copy_from_slice(from);
                }
            }
        }
    };
}
pub(crate) use lanes;
