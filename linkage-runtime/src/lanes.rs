//! Sweeps by blocks of positions, several of which the processor computes at once.
//!
//! A position is computed without a branch: all results, and whether all checks hold. Loops over the positions of a block are then
//! straight-line code, which the compiler turns into vector instructions; each of their operations is rounded as the scalar one is, so
//! that the results have the same bits. Where a check fails, the function for a single position solves the whole block, one by one, and
//! says why a position has no answer.

/// The functions for a scalar; `$bits` are as many as it has.
macro_rules! lanes {
    ($scalar:ident, $bits:ident) => {
        /// How many positions a block has.
        pub const BLOCK: usize = 64;

        /// As a constant, since unoptimised builds ask of what is computed whether it is zero, where it divides.
        const SIZE: usize = size_of::<$scalar>();

        /// How many numbers a line of the cache has. No instruction computes more at once.
        const LINE: usize = 64 / SIZE;

        /// How many numbers lie in front of the first line of the cache that begins among these; where they are aligned to less than their
        /// size, to within one.
        #[inline(always)]
        #[must_use]
        pub fn lead(results: &[$scalar]) -> usize {
            (results.as_ptr().addr() / SIZE).wrapping_neg() % LINE
        }

        /// What has failed, in bits that are gathered by "or": such a loop becomes vector instructions whatever is checked; of the scalar's
        /// size, so that a register has those of as many positions as it computes. The last of them, `UNMARKED`, say nothing.
        pub type Marks = $bits;

        /// All bits for a check that fails, none for one that holds.
        #[inline(always)]
        #[must_use]
        pub fn failed(holds: bool) -> Marks {
            Marks::from(holds).wrapping_sub(1)
        }

        /// Whether no check has failed.
        #[inline(always)]
        #[must_use]
        pub fn all_hold(marks: Marks) -> bool {
            marks >> UNMARKED == 0
        }

        /// A number at each position of a block.
        pub type Column = [$scalar; BLOCK];

        /// What is computed at the positions of a block. One piece of memory: the compiler sees that columns do not overlap. It begins with a
        /// line of the cache, so that no stage reads a register out of two.
        #[derive(Debug)]
        #[repr(align(64))]
        pub struct Columns<const KEPT: usize, const RESULTS: usize> {
            kept: [Column; KEPT],
            results: [Column; RESULTS],
        }

        impl<const KEPT: usize, const RESULTS: usize> Columns<KEPT, RESULTS> {
            /// Nothing yet.
            #[cfg(feature = "std")]
            #[inline(always)]
            const fn new() -> Self {
                Self { kept: [[0.0; BLOCK]; KEPT], results: [[0.0; BLOCK]; RESULTS] }
            }

            /// These columns beside what is given.
            #[inline(always)]
            pub const fn block<G>(&mut self, given: G) -> Block<'_, G, KEPT, RESULTS> {
                Block { given, kept: &mut self.kept, results: &mut self.results }
            }
        }

        /// Positions that are computed at once.
        #[derive(Debug)]
        pub struct Block<'a, G, const KEPT: usize, const RESULTS: usize> {
            /// What the scene reads.
            pub given: G,
            /// What a stage of the computation leaves for later ones.
            pub kept: &'a mut [Column; KEPT],
            /// What the scene finds; later stages read it too.
            pub results: &'a mut [Column; RESULTS],
        }

        /// A sweep of a scene that has `RESULTS` numbers, and keeps `KEPT` between its stages.
        pub trait Lanes<const KEPT: usize, const RESULTS: usize> {
            /// What the scene reads: the series, by blocks.
            type Given;

            /// The same, made once for a sweep.
            fn given(&self) -> Self::Given;

            /// Computes the block that ends at a position, from this lane on: whether all checks hold. Otherwise the results mean nothing. Blocks
            /// follow each other from the first one on.
            fn solve(
                &self,
                given: &mut Self::Given,
                end: usize,
                columns: &mut Columns<KEPT, RESULTS>,
                from: usize,
            ) -> bool;

            /// Writes the results of some positions, those of a block's last lanes.
            fn take(&mut self, positions: core::ops::Range<usize>, results: &[Column; RESULTS]);

            /// Solves a single position.
            fn point(&mut self, index: usize) -> Result<(), crate::Error>;
        }

        /// Solves one position after the other, up to the first without an answer.
        #[cfg(not(feature = "std"))]
        #[inline]
        pub fn sweep<const KEPT: usize, const RESULTS: usize>(
            count: usize,
            _: usize,
            sweep: &mut impl Lanes<KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            crate::sweep::sweep(count, |index| sweep.point(index))
        }

        /// Solves blocks of positions by the widest instructions that the processor has, up to the first position without an answer. The
        /// first results have this `lead`.
        #[cfg(feature = "std")]
        pub fn sweep<const KEPT: usize, const RESULTS: usize>(
            count: usize,
            lead: usize,
            sweep: &mut impl Lanes<KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            crate::processor::instructions().dispatch(Blocks { count, lead, sweep })
        }

        /// All blocks of a sweep.
        #[cfg(feature = "std")]
        struct Blocks<'a, S, const KEPT: usize, const RESULTS: usize> {
            count: usize,
            lead: usize,
            sweep: &'a mut S,
        }

        #[cfg(feature = "std")]
        impl<S: Lanes<KEPT, RESULTS>, const KEPT: usize, const RESULTS: usize> pulp::WithSimd
            for Blocks<'_, S, KEPT, RESULTS>
        {
            type Output = Result<(), crate::SweepError>;

            #[inline(always)]
            fn with_simd<I: pulp::Simd>(self, _: I) -> Self::Output {
                let Self { count, lead, sweep } = self;
                let (mut given, mut columns) = (sweep.given(), Columns::new());
                let mut end = 0_usize;
                while end < count {
                    // A block begins where a line of the results does, as what a register writes into two lines takes twice as long. So the last
                    // few positions of the first block are computed twice.
                    let first = end.saturating_sub((end + LINE - lead) % LINE);
                    end = count.min(first + BLOCK);
                    let (lanes, positions) = (end - first, first..end);
                    // Of the last block the lanes in front are positions of the block before, which have their results already. The minimum
                    // changes nothing, but keeps from the compiler that lanes fill whole registers: it would have each turn of a loop
                    // compute two of them, for which there are too few.
                    let from = BLOCK - lanes.next_multiple_of(LINE).min(BLOCK);
                    if sweep.solve(&mut given, end, &mut columns, from) {
                        sweep.take(positions, &columns.results);
                    } else {
                        one_by_one(positions, sweep)?;
                    }
                }
                Ok(())
            }
        }

        /// Positions among which a check fails: there the function for a single position has the last word.
        #[cfg(feature = "std")]
        #[cold]
        #[inline(never)]
        fn one_by_one<const KEPT: usize, const RESULTS: usize>(
            positions: core::ops::Range<usize>,
            sweep: &mut impl Lanes<KEPT, RESULTS>,
        ) -> Result<(), crate::SweepError> {
            crate::sweep::one_by_one(positions, |index| sweep.point(index))
        }

        /// A series by blocks, each the values in front of its end.
        #[derive(Debug)]
        pub enum Given<'a, T> {
            /// One for each position, read where it lies.
            Each {
                /// All of them.
                values: &'a [T],
                /// The first block: there is one, and it stands for those that end behind the series, of which none is asked for.
                first: &'a [T; BLOCK],
            },
            /// The only block there is, wherever one ends: of what is the same everywhere; or of fewer values than a block has, at its end, and in
            /// front of them the first one once more, as what is computed there counts for the checks.
            Only([T; BLOCK]),
        }

        impl<'a, T: Copy + Default> Given<'a, T> {
            /// All of a series.
            #[inline(always)]
            #[must_use]
            pub fn new(series: &crate::Series<'a, T>) -> Self {
                match *series {
                    crate::Series::Constant(value) => Self::Only([value; BLOCK]),
                    crate::Series::Each(values) => match values.first_chunk() {
                        Some(first) => Self::Each { values, first },
                        None => Self::few(values),
                    },
                }
            }

            #[cold]
            #[inline(never)]
            fn few(values: &[T]) -> Self {
                let mut block = [values.first().copied().unwrap_or_default(); BLOCK];
                block.iter_mut().rev().zip(values.iter().rev()).for_each(|(place, value)| *place = *value);
                Self::Only(block)
            }

            /// The block that ends at a position.
            #[inline(always)]
            #[must_use]
            pub fn block(&self, end: usize) -> &[T; BLOCK] {
                match self {
                    Self::Each { values, first } => values.get(..end).and_then(<[T]>::last_chunk).unwrap_or(first),
                    Self::Only(block) => block,
                }
            }
        }

        /// The parts of a series by blocks, each copied into a column of its own: of values of which not all is read at once, parts lie too
        /// far from each other for a register.
        #[derive(Debug)]
        #[repr(align(64))]
        pub struct Parts<'a, T, const PARTS: usize> {
            columns: [Column; PARTS],
            of: Given<'a, T>,
        }

        impl<'a, T: Copy + Default, const PARTS: usize> Parts<'a, T, PARTS> {
            /// All of a series, of which nothing is copied yet.
            #[inline(always)]
            #[must_use]
            pub fn new(series: &crate::Series<'a, T>) -> Self {
                Self { columns: [[0.0; BLOCK]; PARTS], of: Given::new(series) }
            }

            /// Those of the block that ends at a position. The only block there is, is copied once, with the first one that is asked for.
            #[inline(always)]
            pub fn block(&mut self, end: usize, parts: impl Fn(&T) -> [$scalar; PARTS]) -> &[Column; PARTS] {
                let Self { columns, of } = self;
                // Two calls: only so the compiler sees, in either case, that what is read and the columns do not overlap.
                match of {
                    Given::Each { .. } => copy(of.block(end), columns, parts),
                    Given::Only(block) if end <= BLOCK => copy(block, columns, parts),
                    Given::Only(_) => {}
                }
                columns
            }
        }

        /// Copies the parts of values into columns.
        #[inline(always)]
        fn copy<T: Copy, const PARTS: usize>(
            values: &[T; BLOCK],
            columns: &mut [Column; PARTS],
            parts: impl Fn(&T) -> [$scalar; PARTS],
        ) {
            if let [column] = columns.as_mut_slice() {
                // The compiler packs what is read as a whole.
                *column = values.map(|value| parts(&value)[0]);
                return;
            }
            for (lane, value) in values.iter().enumerate() {
                for (column, part) in columns.iter_mut().zip(parts(value)) {
                    column[lane] = part;
                }
            }
        }

        /// Writes the results of some positions, those of a block's last lanes.
        #[inline(always)]
        pub fn put(to: &mut [$scalar], positions: core::ops::Range<usize>, column: &Column) {
            let to = to.get_mut(positions).unwrap_or_default();
            if let Some(to) = to.first_chunk_mut::<BLOCK>() {
                put_block(to, column);
            } else if let Some(from) = column.get(BLOCK - to.len()..) {
                to.copy_from_slice(from);
            }
        }

        /// Writes a block by whole lines of the cache. Where they do not begin with it, its first and its last numbers are
        /// written as well, across lines.
        #[inline(always)]
        fn put_block(to: &mut Column, column: &Column) {
            let lead = lead(to);
            if lead > 0 {
                put_line(to.first_chunk_mut(), column.first_chunk());
                put_line(to.last_chunk_mut(), column.last_chunk());
            }
            let (to, column) = (to.get_mut(lead..).unwrap_or_default(), column.get(lead..).unwrap_or_default());
            for (to, line) in to.as_chunks_mut::<LINE>().0.iter_mut().zip(column.as_chunks().0) {
                *to = *line;
            }
        }

        #[inline(always)]
        fn put_line(to: Option<&mut [$scalar; LINE]>, line: Option<&[$scalar; LINE]>) {
            if let (Some(to), Some(line)) = (to, line) {
                *to = *line;
            }
        }
    };
}
pub(crate) use lanes;

#[cfg(all(test, feature = "std"))]
mod tests {
    use core::ops::Range;
    use std::vec::Vec;

    use crate::__private::f64::{
        BLOCK, Column, Columns, Given, Lanes, Marks, Parts, all_hold, failed, lead, put, sweep,
    };
    use crate::{Error, Series};

    /// Two blocks, and one more.
    const COUNT: usize = 2 * BLOCK + 1;

    /// The reciprocals of some numbers.
    struct Reciprocals<'a> {
        of: &'a [f64],
        results: &'a mut [f64],
    }

    impl<'a> Lanes<0, 1> for Reciprocals<'a> {
        type Given = Given<'a, f64>;

        fn given(&self) -> Self::Given {
            Given::new(&Series::Each(self.of))
        }

        fn solve(&self, given: &mut Self::Given, end: usize, columns: &mut Columns<0, 1>, from: usize) -> bool {
            let mut marks: Marks = 0;
            let block = columns.block(given.block(end));
            for lane in from..BLOCK {
                let given = block.given[lane];
                block.results[0][lane] = 1.0 / given;
                marks |= failed(given.is_normal());
            }
            all_hold(marks)
        }

        fn take(&mut self, positions: Range<usize>, [column]: &[Column; 1]) {
            put(self.results, positions, column);
        }

        fn point(&mut self, index: usize) -> Result<(), Error> {
            if self.of[index] == 0.0 {
                return Err(Error::NotFinite { what: "a reciprocal" });
            }
            self.results[index] = -1.0;
            Ok(())
        }
    }

    /// To fill a register, the first position is computed once more in front of it, or what the block before has there: their checks hold.
    #[test]
    fn no_block_is_solved_one_by_one_for_what_is_in_front_of_it() {
        for count in 0..=COUNT {
            let (of, mut results) = ([2.0; COUNT], [0.0; COUNT]);
            let (of, results) = (&of[..count], &mut results[..count]);
            sweep(count, 0, &mut Reciprocals { of, results }).expect("none is zero");
            assert_eq!(results, &[0.5; COUNT][..count]);
        }
    }

    #[test]
    fn a_block_in_which_a_check_fails_is_solved_one_by_one_up_to_there() {
        let zeros = [0, 5, BLOCK - 7, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK - 1, 2 * BLOCK];
        for (lead, zero) in (0..8).flat_map(|lead| zeros.map(|zero| (lead, zero))) {
            let (mut of, mut results) = ([2.0; COUNT], [0.0; COUNT]);
            of[zero] = 0.0;
            sweep(of.len(), lead, &mut Reciprocals { of: &of, results: &mut results }).expect_err("one is zero");
            // The first block that ends behind it.
            let (mut begin, mut end) = (0, BLOCK);
            while end <= zero {
                begin = end - (end + 8 - lead) % 8;
                end = begin + BLOCK;
            }
            let parts = [&results[..begin], &results[begin..zero], &results[zero..]];
            for (part, expected) in parts.into_iter().zip([0.5, -1.0, 0.0]) {
                assert_eq!(part, &[expected; COUNT][..part.len()]);
            }
        }
    }

    /// A check may fail at a position that has an answer: the blocks behind are computed as others.
    #[test]
    fn a_block_is_solved_one_by_one_for_nothing() {
        let (mut of, mut results) = ([2.0; COUNT], [0.0; COUNT]);
        of[5] = f64::MIN_POSITIVE / 4.0;
        sweep(of.len(), 0, &mut Reciprocals { of: &of, results: &mut results }).expect("all have one");
        assert!(results[..BLOCK].iter().all(|one_by_one| *one_by_one < 0.0));
        assert_eq!(results[BLOCK..], [0.5; COUNT - BLOCK]);
    }

    /// The positions of each block, of which the last lanes are computed.
    struct Blocks(Vec<Range<usize>>);

    impl Lanes<0, 1> for Blocks {
        type Given = ();

        fn given(&self) {}

        fn solve(&self, (): &mut (), end: usize, columns: &mut Columns<0, 1>, from: usize) -> bool {
            let [column] = columns.block(()).results;
            for (lane, number) in column.iter_mut().enumerate() {
                *number = if lane < from { -1.0 } else { number_of((end + lane).saturating_sub(BLOCK)) };
            }
            true
        }

        fn take(&mut self, positions: Range<usize>, [column]: &[Column; 1]) {
            let computed = column.iter().filter(|number| **number >= 0.0).count();
            assert_eq!(computed % (64 / size_of::<f64>()), 0, "registers are full");
            let expected: Vec<f64> = positions.clone().map(number_of).collect();
            assert_eq!(column[BLOCK - positions.len()..], expected);
            self.0.push(positions);
        }

        fn point(&mut self, _: usize) -> Result<(), Error> {
            Err(Error::NotFinite { what: "none of these" })
        }
    }

    fn number_of(position: usize) -> f64 {
        f64::from(u8::try_from(position).expect("few"))
    }

    #[test]
    fn blocks_begin_with_a_line_of_the_results_and_leave_nothing_out() {
        let line = 64 / size_of::<f64>();
        for (lead, count) in (0..line).flat_map(|lead| (1..=COUNT).map(move |count| (lead, count))) {
            let mut blocks = Blocks(Vec::new());
            sweep(count, lead, &mut blocks).expect("no check fails");
            let Blocks(blocks) = blocks;
            assert_eq!((blocks[0].start, blocks[blocks.len() - 1].end), (0, count));
            for pair in blocks.windows(2) {
                assert_eq!(pair[1].start % line, lead);
                assert!(
                    pair[1].start <= pair[0].end && pair[1].start + line > pair[0].end && pair[1].end > pair[0].end
                );
            }
            assert!(blocks.iter().all(|block| block.len() <= BLOCK) && blocks.len() <= count / BLOCK + 2);
        }
    }

    /// Wherever lines of the cache begin.
    macro_rules! a_block_is_written_where_it_belongs {
        ($scalar:ident) => {
            let column: [$scalar; BLOCK] = core::array::from_fn(|lane| $scalar::from(u8::try_from(lane).expect("few")));
            for begin in 0..64 / size_of::<$scalar>() {
                for length in [1, 7, BLOCK - 1, BLOCK] {
                    let mut all = [-1.0; 2 * BLOCK];
                    crate::__private::$scalar::put(&mut all, begin..begin + length, &column);
                    assert_eq!(all[begin..begin + length], column[BLOCK - length..]);
                    assert!(all[..begin].iter().chain(&all[begin + length..]).all(|other| *other < 0.0));
                }
            }
        };
    }

    #[test]
    fn blocks_are_written_where_they_belong() {
        a_block_is_written_where_it_belongs!(f32);
        a_block_is_written_where_it_belongs!(f64);
    }

    #[test]
    fn a_line_of_the_cache_begins_behind_the_lead() {
        let numbers = [0.0; BLOCK];
        for begin in 0..BLOCK / 2 {
            let lead = lead(&numbers[begin..]);
            assert!(lead < 8 && numbers[begin + lead..].as_ptr().addr() % 64 < size_of::<f64>());
        }
    }

    #[test]
    fn values_of_blocks_are_those_in_front_of_their_ends() {
        let values: [f64; COUNT] = core::array::from_fn(|index| f64::from(u8::try_from(index).expect("few")));
        for count in 1..=COUNT {
            let series = Series::Each(&values[..count]);
            let (given, mut both) = (Given::new(&series), Parts::new(&series));
            for end in (BLOCK.min(count)..count).chain([count]) {
                let expected: [f64; BLOCK] = core::array::from_fn(|lane| values[(end + lane).saturating_sub(BLOCK)]);
                assert_eq!(given.block(end).as_slice(), expected.as_slice());
                assert_eq!(both.block(end, |value| [-value, *value]), &[expected.map(|value| -value), expected]);
            }
        }
    }

    #[test]
    fn blocks_of_what_is_the_same_everywhere() {
        let series = Series::Constant(2.0);
        let (given, mut more) = (Given::new(&series), Parts::new(&series));
        for end in [BLOCK, 2 * BLOCK] {
            assert_eq!(given.block(end).as_slice(), [2.0; BLOCK].as_slice());
            assert_eq!(more.block(end, |value| [value + 1.0]), &[[3.0; BLOCK]]);
        }
    }
}
