//! Rows of lanes.

use crate::kernel::{NO_ROW, Row};

/// One number for each lane.
pub(super) type Lane<const N: usize> = [f32; N];

/// So many lanes are read before any result is written: the compiler need not ask whether rows are one and the same then, and
/// these many results fit into registers.
const PIECE: usize = 32;

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

    /// An operation on all lanes of some rows, whose results go into another one. A plan never reads what the same step writes.
    #[inline(always)]
    pub(super) fn apply<const S: usize>(
        &mut self,
        to: Row,
        from: [Row; S],
        f: impl Fn([f32; S]) -> f32,
    ) {
        for first in (0..N).step_by(PIECE) {
            let mut read = [&[][..]; S];
            for (place, row) in read.iter_mut().zip(from) {
                let row = self.get(row).and_then(|row| row.get(first..));
                *place = row.unwrap_or_default();
            }
            let mut results = [0.0; PIECE];
            if let Some(whole) = pieces(&read) {
                for (lane, result) in results.iter_mut().enumerate() {
                    *result = f(whole.map(|row| row[lane]));
                }
            } else {
                for (lane, result) in results.iter_mut().enumerate().take(N - first) {
                    *result = f(read.map(|row| row.get(lane).copied().unwrap_or_default()));
                }
            }
            self.write(to, first, &results);
        }
    }

    /// Loads a row from outside, each number through `f`.
    #[inline(always)]
    pub(super) fn load(&mut self, to: Row, from: &Lane<N>, f: impl Fn(f32) -> f32) {
        for (number, piece) in from.chunks(PIECE).enumerate() {
            let mut results = [0.0; PIECE];
            match piece.first_chunk::<PIECE>() {
                Some(piece) => {
                    for (lane, result) in results.iter_mut().enumerate() {
                        *result = f(piece[lane]);
                    }
                }
                None => {
                    for (result, value) in results.iter_mut().zip(piece) {
                        *result = f(*value);
                    }
                }
            }
            self.write(to, number * PIECE, &results);
        }
    }

    /// Writes some lanes of a row.
    #[inline(always)]
    fn write(&mut self, row: Row, first: usize, values: &[f32; PIECE]) {
        let row = self.rows.get_mut(row as usize);
        let Some(lanes) = row.and_then(|row| row.0.get_mut(first..)) else {
            return;
        };
        match lanes.first_chunk_mut::<PIECE>() {
            Some(lanes) => *lanes = *values,
            None => {
                for (lane, value) in lanes.iter_mut().zip(values) {
                    *lane = *value;
                }
            }
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

/// The first piece of each row, if all have one.
#[inline(always)]
fn pieces<'r, const S: usize>(rows: &[&'r [f32]; S]) -> Option<[&'r [f32; PIECE]; S]> {
    let mut pieces = [&[0.0; PIECE]; S];
    for (piece, row) in pieces.iter_mut().zip(rows) {
        *piece = row.first_chunk()?;
    }
    Some(pieces)
}
