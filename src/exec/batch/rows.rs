//! Rows of lanes.

use crate::kernel::{NO_ROW, Row};

/// One number for each lane.
pub(super) type Lane<const N: usize> = [f32; N];

/// A row where no vector of it lies in two lines of the cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Aligned<const N: usize>(Lane<N>);

/// All rows of a batch.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows<const N: usize> {
    rows: Vec<Aligned<N>>,
}

impl<const N: usize> Rows<N> {
    /// Makes room for so many.
    pub(super) fn resize(&mut self, count: usize) {
        self.rows.resize(count, Aligned([0.0; N]));
    }

    #[inline(always)]
    pub(super) fn get(&self, row: Row) -> Option<&Lane<N>> {
        self.rows.get(row as usize).map(|row| &row.0)
    }

    /// The number in the first lane of each.
    pub(super) fn first(&self) -> Vec<f32> {
        let first = |row: &Aligned<N>| row.0.first().copied().unwrap_or_default();
        self.rows.iter().map(first).collect()
    }

    /// The same number in all lanes of a row.
    pub(super) fn fill(&mut self, row: Row, number: f32) {
        if let Some(lanes) = self.rows.get_mut(row as usize) {
            lanes.0 = [number; N];
        }
    }

    /// An operation on all lanes of some rows; none if there is no such row.
    ///
    /// The results are values of their own, and so for all lanes the rows are read before anything is written: the compiler
    /// need not ask whether one of them is written at the same time, and keeps the results in registers.
    #[inline(always)]
    pub(super) fn each_lane<const S: usize>(
        &self,
        from: [Row; S],
        f: impl Fn([f32; S]) -> f32,
    ) -> Option<Lane<N>> {
        let mut read = [&[0.0; N]; S];
        for (place, row) in read.iter_mut().zip(from) {
            *place = self.get(row)?;
        }
        let mut results = [0.0; N];
        for (lane, result) in results.iter_mut().enumerate() {
            *result = f(read.map(|row| row[lane]));
        }
        Some(results)
    }

    /// Writes a row.
    #[inline(always)]
    pub(super) fn set(&mut self, row: Row, values: &Lane<N>) {
        if let Some(lanes) = self.rows.get_mut(row as usize) {
            lanes.0 = *values;
        }
    }

    /// Copies results into their rows, each through `finish`.
    #[inline(always)]
    pub(super) fn store(&mut self, rows: &[Row], values: &[Lane<N>], finish: impl Fn(f32) -> f32) {
        for (row, values) in rows.iter().zip(values) {
            if *row == NO_ROW {
                continue;
            }
            if let Some(lanes) = self.rows.get_mut(*row as usize) {
                for (to, from) in lanes.0.iter_mut().zip(values) {
                    *to = finish(*from);
                }
            }
        }
    }

    /// Changes a row.
    #[inline(always)]
    pub(super) fn update(&mut self, row: Row, change: impl Fn(f32) -> f32) {
        if let Some(lanes) = self.rows.get_mut(row as usize) {
            for number in &mut lanes.0 {
                *number = change(*number);
            }
        }
    }
}
