//! Sweeps by blocks of positions, several of which the processor computes at once.
//!
//! A position is computed without a branch: all results, and whether all checks hold. A loop over the positions of a block is then
//! straight-line code, which the compiler turns into vector instructions; each of their operations is rounded as the scalar one is, so
//! that the results have the same bits. Where a check fails, the function for a single position says why.

/// The functions for a scalar.
macro_rules! lanes {
    ($scalar:ident) => {
        /// How many positions a block has.
        pub const BLOCK: usize = 64;

        /// A number at each position of a block.
        pub type Column = [$scalar; BLOCK];

        /// A sweep of a scene that reads `GIVEN` numbers and has `RESULTS` numbers.
        pub trait Lanes<const GIVEN: usize, const RESULTS: usize> {
            /// The results of a position, and whether all checks hold. If not, the numbers mean nothing.
            fn lane(&self, given: [$scalar; GIVEN]) -> ([$scalar; RESULTS], bool);

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
        pub fn sweep<const GIVEN: usize, const RESULTS: usize>(
            count: usize,
            sweep: &mut impl Lanes<GIVEN, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            crate::sweep::sweep(count, |index| sweep.point(index))
        }

        /// Solves blocks of positions by the widest instructions that the processor has, up to the first position without an answer.
        #[cfg(feature = "std")]
        pub fn sweep<const GIVEN: usize, const RESULTS: usize>(
            count: usize,
            sweep: &mut impl Lanes<GIVEN, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            let processor = crate::processor::instructions();
            let (mut given, mut results, mut holds) = ([[0.0; BLOCK]; GIVEN], [[0.0; BLOCK]; RESULTS], [0.0; BLOCK]);
            let mut first = 0;
            while first < count {
                sweep.give(first, &mut given);
                let (results_of, holds_of) = (&mut results, &mut holds);
                processor.dispatch(Block { sweep: &*sweep, given: &given, results: results_of, holds: holds_of });
                let lanes = BLOCK.min(count - first);
                let mut from = 0;
                while from < lanes {
                    let right = holds.iter().take(lanes).skip(from).take_while(|holds| **holds > 0.0).count();
                    sweep.take(first, from..from + right, &results);
                    from += right;
                    if from < lanes {
                        let index = first + from;
                        sweep.point(index).map_err(|error| crate::SweepError::Position { index, error })?;
                        from += 1;
                    }
                }
                first += lanes;
            }
            Ok(())
        }

        /// All positions of a block.
        #[cfg(feature = "std")]
        struct Block<'a, S, const GIVEN: usize, const RESULTS: usize> {
            sweep: &'a S,
            given: &'a [Column; GIVEN],
            results: &'a mut [Column; RESULTS],
            holds: &'a mut Column,
        }

        #[cfg(feature = "std")]
        impl<S: Lanes<GIVEN, RESULTS>, const GIVEN: usize, const RESULTS: usize> pulp::WithSimd
            for Block<'_, S, GIVEN, RESULTS>
        {
            type Output = ();

            #[inline(always)]
            fn with_simd<I: pulp::Simd>(self, _: I) {
                let Self { sweep, given, results, holds } = self;
                for lane in 0..BLOCK {
                    let (values, right) = sweep.lane(core::array::from_fn(
                        #[inline(always)]
                        |which| given[which][lane],
                    ));
                    for which in 0..RESULTS {
                        results[which][lane] = values[which];
                    }
                    holds[lane] = if right { 1.0 } else { 0.0 };
                }
            }
        }

        /// Lays out the parts of a series, each in a column of its own. What is the same everywhere stays where it is after the first
        /// block.
        pub fn lay<T: Copy, const PARTS: usize>(
            series: &crate::Series<'_, T>,
            first: usize,
            columns: [&mut Column; PARTS],
            parts: impl Fn(T) -> [$scalar; PARTS],
        ) {
            match series {
                crate::Series::Constant(value) => {
                    if first == 0 {
                        columns.into_iter().zip(parts(*value)).for_each(|(column, part)| column.fill(part));
                    }
                }
                crate::Series::Each(values) => {
                    // A loop for each part: the compiler leaves out the others.
                    for (which, column) in columns.into_iter().enumerate() {
                        for (place, value) in column.iter_mut().zip(values.get(first..).unwrap_or_default()) {
                            *place = parts(*value)[which];
                        }
                    }
                }
            }
        }

        /// Copies some lanes of the block that begins at a position to where results go.
        pub fn put(to: &mut [$scalar], first: usize, lanes: core::ops::Range<usize>, column: &Column) {
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
