//! Rows of lanes.

use crate::kernel::{NO_ROW, Row};
use crate::semantics::flush;

/// One number for each lane.
pub(super) type Lane<const N: usize> = [f32; N];

/// All rows of a batch.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows<const N: usize> {
    rows: Vec<Lane<N>>,
}

impl<const N: usize> Rows<N> {
    /// Makes room for so many.
    pub(super) fn resize(&mut self, count: usize) {
        self.rows.resize(count, [0.0; N]);
    }

    pub(super) fn get(&self, row: Row) -> Option<&Lane<N>> {
        self.rows.get(row as usize)
    }

    /// The same number in all lanes of a row.
    pub(super) fn fill(&mut self, row: Row, number: f32) {
        if let Some(lanes) = self.rows.get_mut(row as usize) {
            *lanes = [number; N];
        }
    }

    /// The numbers of a row; denormal ones as zero if `flushed`.
    #[inline(always)]
    pub(super) fn copy(&mut self, row: Row, values: &Lane<N>, flushed: bool) {
        if let Some(lanes) = self.rows.get_mut(row as usize) {
            match flushed {
                true => (lanes.iter_mut().zip(values)).for_each(|(to, from)| *to = flush(*from)),
                false => *lanes = *values,
            }
        }
    }

    /// A row to write and the rows to read. A plan never reads what the same step writes.
    #[inline(always)]
    pub(super) fn split<const S: usize>(
        &mut self,
        to: Row,
        from: [Row; S],
    ) -> Option<(&mut Lane<N>, [&Lane<N>; S])> {
        let to = to as usize;
        let (below, rest) = self.rows.split_at_mut_checked(to)?;
        let (written, above) = rest.split_first_mut()?;
        let mut read = [&[0.0; N]; S];
        for (place, row) in read.iter_mut().zip(from) {
            let row = row as usize;
            *place = match row < to {
                true => below.get(row)?,
                false => above.get(row.wrapping_sub(to + 1))?,
            };
        }
        Some((written, read))
    }

    /// Copies results into their rows, each through `finish`.
    #[inline(always)]
    pub(super) fn store(&mut self, rows: &[Row], values: &[Lane<N>], finish: impl Fn(f32) -> f32) {
        for (row, values) in rows.iter().zip(values) {
            if *row == NO_ROW {
                continue;
            }
            if let Some(lanes) = self.rows.get_mut(*row as usize) {
                for (to, from) in lanes.iter_mut().zip(values) {
                    *to = finish(*from);
                }
            }
        }
    }

    /// Changes a row.
    #[inline(always)]
    pub(super) fn update(&mut self, row: Row, change: impl Fn(f32) -> f32) {
        if let Some(lanes) = self.rows.get_mut(row as usize) {
            for number in lanes {
                *number = change(*number);
            }
        }
    }
}
