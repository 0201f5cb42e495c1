//! Fourier transform of real fields in a box that repeats, with the symbols of difference operators applied on the way.
//!
//! A field goes through its lines along the first direction (real to complex), then along the second, and last along the third, where the caller's symbol is
//! applied while a line is in the nearest cache and the way back begins at once. So memory is passed over three times and no direction is ever transposed as a whole.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::parallel;

/// A Fourier coefficient.
pub(super) type Mode = Complex<f64>;

/// Lines along the third direction that are worked on together: whole cache lines of the field.
const LINES: usize = 16;

/// Transforms of a box of given cells.
#[derive(Clone)]
pub struct Spectrum {
    cells: [usize; 3],
    /// Modes along the first direction; the others follow because fields are real.
    first_modes: usize,
    first: Arc<dyn RealToComplex<f64>>,
    first_back: Arc<dyn ComplexToReal<f64>>,
    second: [Arc<dyn Fft<f64>>; 2],
    third: [Arc<dyn Fft<f64>>; 2],
    /// Fields of modes that nobody uses now. Fresh memory of that size, page by page from the system, costs a third of a transform.
    idle: Arc<Mutex<Vec<Vec<Mode>>>>,
}

/// Where a line of modes along the third direction lies in the other two.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineOfModes {
    /// Number of its mode along the first direction.
    pub(super) first: usize,
    /// Number of its mode along the second direction.
    pub(super) second: usize,
}

impl std::fmt::Debug for Spectrum {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Spectrum").field("cells", &self.cells).finish_non_exhaustive()
    }
}

impl Spectrum {
    /// Transforms for fields of so many cells in each direction.
    pub fn new(cells: [usize; 3]) -> Spectrum {
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        let mut both = |length| [complex.plan_fft_forward(length), complex.plan_fft_inverse(length)];
        Spectrum {
            cells,
            first_modes: cells[0] / 2 + 1,
            first: real.plan_fft_forward(cells[0]),
            first_back: real.plan_fft_inverse(cells[0]),
            second: both(cells[1]),
            third: both(cells[2]),
            idle: Arc::default(),
        }
    }

    /// Replaces some fields by what `symbol` makes of their modes. It is called with every line of modes of all fields and their share in the normalisation is
    /// the caller's: a transform there and back multiplies by the number of cells.
    pub(super) fn apply<const FIELDS: usize>(
        &self,
        fields: [&mut [f64]; FIELDS],
        symbol: impl Fn(LineOfModes, &mut [&mut [Mode]; FIELDS]) + Sync + Send,
    ) {
        let mut fields = fields;
        let mut modes: [Vec<Mode>; FIELDS] = std::array::from_fn(|field| self.forward(fields[field]));
        self.along_third(&mut modes, &symbol);
        for (field, modes) in fields.iter_mut().zip(&mut modes) {
            self.backward(modes, field);
        }
        self.idle().extend(modes);
    }

    /// What is left of a thread that panicked with it is memory as good as any.
    fn idle(&self) -> MutexGuard<'_, Vec<Vec<Mode>>> {
        self.idle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn plane(&self) -> usize {
        self.first_modes * self.cells[1]
    }

    /// Modes along the first two directions, in planes of the third, second direction fastest.
    fn forward(&self, field: &[f64]) -> Vec<Mode> {
        let [nx, ny, _] = self.cells;
        let idle = self.idle().pop();
        let mut modes = idle.unwrap_or_else(|| vec![Mode::default(); self.plane() * self.cells[2]]);
        let mut planes: Vec<(&[f64], &mut [Mode])> = field.chunks_exact(nx * ny).zip(modes.chunks_exact_mut(self.plane())).collect();
        parallel::for_each_part(&mut planes, |part| {
            let mut line = self.first.make_input_vec();
            let mut rows = vec![Mode::default(); self.plane()];
            let mut scratch = vec![Mode::default(); self.first.get_scratch_len().max(self.second[0].get_inplace_scratch_len())];
            for (field, modes) in part {
                for (values, row) in field.chunks_exact(nx).zip(rows.chunks_exact_mut(self.first_modes)) {
                    line.copy_from_slice(values);
                    // Lengths are those of the plan.
                    let _ = self.first.process_with_scratch(&mut line, row, &mut scratch);
                }
                transpose(&rows, self.first_modes, modes);
                self.second[0].process_with_scratch(modes, &mut scratch);
            }
        });
        modes
    }

    fn backward(&self, modes: &mut [Mode], field: &mut [f64]) {
        let [nx, ny, _] = self.cells;
        let mut planes: Vec<(&mut [f64], &mut [Mode])> =
            field.chunks_exact_mut(nx * ny).zip(modes.chunks_exact_mut(self.plane())).collect();
        parallel::for_each_part(&mut planes, |part| {
            let mut rows = vec![Mode::default(); self.plane()];
            let mut scratch = vec![Mode::default(); self.first_back.get_scratch_len().max(self.second[1].get_inplace_scratch_len())];
            for (field, modes) in part {
                self.second[1].process_with_scratch(modes, &mut scratch);
                transpose(modes, ny, &mut rows);
                for (values, row) in field.chunks_exact_mut(nx).zip(rows.chunks_exact_mut(self.first_modes)) {
                    // Real but for rounding, as those of a real line must be.
                    row[0].im = 0.0;
                    if nx.is_multiple_of(2) {
                        row[self.first_modes - 1].im = 0.0;
                    }
                    let _ = self.first_back.process_with_scratch(row, values, &mut scratch);
                }
            }
        });
    }

    /// Lines along the third direction there, through the symbol, and back.
    fn along_third<const FIELDS: usize>(
        &self,
        modes: &mut [Vec<Mode>; FIELDS],
        symbol: &(impl Fn(LineOfModes, &mut [&mut [Mode]; FIELDS]) + Sync + Send),
    ) {
        let (plane, length) = (self.plane(), self.cells[2]);
        let blocks = plane.div_ceil(LINES);
        // Every block of lines owns its stretch of each plane of each field.
        let mut stretches: Vec<[Vec<&mut [Mode]>; FIELDS]> =
            (0..blocks).map(|_| std::array::from_fn(|_| Vec::with_capacity(length))).collect();
        for (field, modes) in modes.iter_mut().enumerate() {
            for plane in modes.chunks_exact_mut(plane) {
                for (block, stretch) in plane.chunks_mut(LINES).enumerate() {
                    stretches[block][field].push(stretch);
                }
            }
        }
        let mut numbered: Vec<(usize, [Vec<&mut [Mode]>; FIELDS])> = stretches.into_iter().enumerate().collect();
        parallel::for_each_part(&mut numbered, |part| {
            let mut lines: [Vec<Mode>; FIELDS] = std::array::from_fn(|_| vec![Mode::default(); LINES * length]);
            let scratch = self.third[0].get_inplace_scratch_len().max(self.third[1].get_inplace_scratch_len());
            let mut scratch = vec![Mode::default(); scratch];
            for (block, stretches) in part {
                let count = stretches[0][0].len();
                for (lines, stretches) in lines.iter_mut().zip(stretches.iter()) {
                    gather(stretches, lines, length);
                    self.third[0].process_with_scratch(&mut lines[..count * length], &mut scratch);
                }
                for line in 0..count {
                    let number = *block * LINES + line;
                    let place = LineOfModes { first: number / self.cells[1], second: number % self.cells[1] };
                    let mut of_fields = lines.each_mut().map(|lines| &mut lines[line * length..][..length]);
                    symbol(place, &mut of_fields);
                }
                for (lines, stretches) in lines.iter_mut().zip(stretches.iter_mut()) {
                    self.third[1].process_with_scratch(&mut lines[..count * length], &mut scratch);
                    scatter(lines, stretches, length);
                }
            }
        });
    }
}

fn gather(stretches: &[&mut [Mode]], lines: &mut [Mode], length: usize) {
    for (place, stretch) in stretches.iter().enumerate() {
        for (line, mode) in stretch.iter().enumerate() {
            lines[line * length + place] = *mode;
        }
    }
}

fn scatter(lines: &[Mode], stretches: &mut [&mut [Mode]], length: usize) {
    for (place, stretch) in stretches.iter_mut().enumerate() {
        for (line, mode) in stretch.iter_mut().enumerate() {
            *mode = lines[line * length + place];
        }
    }
}

/// Rows of a given length to columns, in tiles that stay in the cache.
fn transpose(rows: &[Mode], length: usize, columns: &mut [Mode]) {
    const TILE: usize = 8;
    let count = rows.len() / length;
    for first_row in (0..count).step_by(TILE) {
        for first_column in (0..length).step_by(TILE) {
            for column in first_column..(first_column + TILE).min(length) {
                for row in first_row..(first_row + TILE).min(count) {
                    columns[column * count + row] = rows[row * length + column];
                }
            }
        }
    }
}
