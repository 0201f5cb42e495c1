//! Lines of values as sums of waves that the second difference only scales: Fourier's where the box repeats, sines and cosines between sides.

use std::f64::consts::PI;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustdct::{DctPlanner, Dst1, TransformType2And3, TransformType4};

use super::sides::Condition;
use super::spectrum::Mode;

/// Which waves.
#[derive(Clone)]
enum Waves {
    /// Real and imaginary parts of Fourier's, side by side.
    Fourier(Arc<dyn RealToComplex<f64>>, Arc<dyn ComplexToReal<f64>>),
    /// Cosines with crests on both sides; values between faces.
    Cosines(Arc<dyn TransformType2And3<f64>>),
    /// Sines with nodes on both sides; values between faces.
    Sines(Arc<dyn TransformType2And3<f64>>),
    /// Cosines with a crest on the lower side and a node on the upper one; values between faces.
    QuarterCosines(Arc<dyn TransformType4<f64>>),
    /// Sines with a node on the lower side and a crest on the upper one; values between faces.
    QuarterSines(Arc<dyn TransformType4<f64>>),
    /// Sines with nodes on both sides; values on inner faces.
    FaceSines(Arc<dyn Dst1<f64>>),
    /// Sines with a node on the lower side and a crest on the upper one; values on faces, the last of them on the upper side.
    FaceQuarterSines(Arc<dyn TransformType2And3<f64>>),
    /// Cosines with a crest on the lower side and a node on the upper one; values on faces, the first of them on the lower side.
    FaceQuarterCosines(Arc<dyn TransformType2And3<f64>>),
}

/// The waves of the lines of one field along one direction.
#[derive(Clone)]
pub(super) struct Line {
    waves: Waves,
    /// Unknowns.
    pub(super) length: usize,
    /// Minus the second difference of each wave in 1/m^2.
    pub(super) squares: Vec<f64>,
    /// What a transform there and back multiplies by.
    pub(super) gain: f64,
}

/// Memory of one thread for the transforms of a line.
pub(super) struct Workspace {
    modes: Vec<Mode>,
    complex: Vec<Mode>,
    real: Vec<f64>,
}

impl Line {
    /// The waves of a direction of so many cells of a spacing in m, under conditions on its sides (or none, where it repeats), for values on faces or between them.
    pub(super) fn new(cells: usize, spacing: f64, conditions: Option<[Condition; 2]>, on_faces: bool) -> Line {
        let mut planner = DctPlanner::new();
        let given = conditions.map(|pair| pair.map(|condition| condition != Condition::Level));
        // The wave of place k has k plus so many half waves over the length of the box.
        let (waves, length, shift) = match (given, on_faces) {
            (None, _) => return Line::fourier(cells, spacing),
            (Some([false, false]), _) => (Waves::Cosines(planner.plan_dct2(cells)), cells, 0.0),
            (Some([true, true]), false) => (Waves::Sines(planner.plan_dst2(cells)), cells, 1.0),
            (Some([false, true]), false) => (Waves::QuarterCosines(planner.plan_dct4(cells)), cells, 0.5),
            (Some([true, false]), false) => (Waves::QuarterSines(planner.plan_dst4(cells)), cells, 0.5),
            (Some([true, true]), true) => (Waves::FaceSines(planner.plan_dst1(cells - 1)), cells - 1, 1.0),
            (Some([true, false]), true) => (Waves::FaceQuarterSines(planner.plan_dst3(cells)), cells, 0.5),
            (Some([false, true]), true) => (Waves::FaceQuarterCosines(planner.plan_dct3(cells)), cells, 0.5),
        };
        let square = |place: usize| square((place as f64 + shift) / 2.0, cells, spacing);
        Line { waves, length, squares: (0..length).map(square).collect(), gain: cells as f64 / 2.0 }
    }

    fn fourier(cells: usize, spacing: f64) -> Line {
        let mut planner = RealFftPlanner::new();
        let waves = Waves::Fourier(planner.plan_fft_forward(cells), planner.plan_fft_inverse(cells));
        let square = |place: usize| square(place.div_ceil(2) as f64, cells, spacing);
        Line { waves, length: cells, squares: (0..cells).map(square).collect(), gain: cells as f64 }
    }

    /// Memory for [`Line::forward`] and [`Line::backward`].
    pub(super) fn workspace(&self) -> Workspace {
        let (modes, complex, real) = match &self.waves {
            Waves::Fourier(there, back) => (self.length / 2 + 1, there.get_scratch_len().max(back.get_scratch_len()), 0),
            Waves::Cosines(plan) | Waves::Sines(plan) | Waves::FaceQuarterSines(plan) | Waves::FaceQuarterCosines(plan) => {
                (0, 0, plan.get_scratch_len())
            }
            Waves::QuarterCosines(plan) | Waves::QuarterSines(plan) => (0, 0, plan.get_scratch_len()),
            Waves::FaceSines(plan) => (0, 0, plan.get_scratch_len()),
        };
        Workspace { modes: vec![Mode::default(); modes], complex: vec![Mode::default(); complex], real: vec![0.0; real] }
    }

    /// Values to amplitudes.
    pub(super) fn forward(&self, line: &mut [f64], space: &mut Workspace) {
        match &self.waves {
            Waves::Fourier(there, _) => {
                // Lengths are those of the plan.
                let _ = there.process_with_scratch(line, &mut space.modes, &mut space.complex);
                pack(&space.modes, line);
            }
            Waves::Cosines(plan) => plan.process_dct2_with_scratch(line, &mut space.real),
            Waves::Sines(plan) => plan.process_dst2_with_scratch(line, &mut space.real),
            Waves::QuarterCosines(plan) => plan.process_dct4_with_scratch(line, &mut space.real),
            Waves::QuarterSines(plan) => plan.process_dst4_with_scratch(line, &mut space.real),
            Waves::FaceSines(plan) => {
                // From length 25 on this plan reads two places of its memory that it takes to be zero; what it left there would grow from line to line.
                space.real.fill(0.0);
                plan.process_dst1_with_scratch(line, &mut space.real);
            }
            Waves::FaceQuarterSines(plan) => plan.process_dst3_with_scratch(line, &mut space.real),
            Waves::FaceQuarterCosines(plan) => plan.process_dct3_with_scratch(line, &mut space.real),
        }
    }

    /// Amplitudes to values, times [`Line::gain`].
    pub(super) fn backward(&self, line: &mut [f64], space: &mut Workspace) {
        match &self.waves {
            Waves::Fourier(_, back) => {
                unpack(line, &mut space.modes);
                let _ = back.process_with_scratch(&mut space.modes, line, &mut space.complex);
            }
            Waves::Cosines(plan) => plan.process_dct3_with_scratch(line, &mut space.real),
            Waves::Sines(plan) => plan.process_dst3_with_scratch(line, &mut space.real),
            Waves::FaceQuarterSines(plan) => plan.process_dst2_with_scratch(line, &mut space.real),
            Waves::FaceQuarterCosines(plan) => plan.process_dct2_with_scratch(line, &mut space.real),
            // Their own inverses.
            Waves::QuarterCosines(_) | Waves::QuarterSines(_) | Waves::FaceSines(_) => self.forward(line, space),
        }
    }
}

/// Minus the second difference of a wave of so many wave lengths over a box in 1/m^2.
fn square(waves: f64, cells: usize, spacing: f64) -> f64 {
    let root = 2.0 * (PI * waves / cells as f64).sin() / spacing;
    root * root
}

/// Real part of mode 0, then real and imaginary part of each other; the imaginary parts that are zero are left out.
fn pack(modes: &[Mode], line: &mut [f64]) {
    line[0] = modes[0].re;
    for (pair, mode) in line[1..].chunks_mut(2).zip(&modes[1..]) {
        pair[0] = mode.re;
        if let Some(imaginary) = pair.get_mut(1) {
            *imaginary = mode.im;
        }
    }
}

fn unpack(line: &[f64], modes: &mut [Mode]) {
    modes[0] = Mode::new(line[0], 0.0);
    for (pair, mode) in line[1..].chunks(2).zip(&mut modes[1..]) {
        *mode = Mode::new(pair[0], pair.get(1).copied().unwrap_or(0.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each wave is an eigenvector of the second difference with reflected ends, at all lengths: transforms differ in their algorithms by length.
    #[test]
    fn transforms_there_and_back_scale_the_second_difference() {
        let pairs = [None, Some([false, false]), Some([true, true]), Some([false, true]), Some([true, false])];
        for cells in (4..70).chain([97, 100, 127, 128]) {
            for (pair, on_faces) in pairs.into_iter().flat_map(|pair| [(pair, false), (pair, true)]) {
                if on_faces && pair == Some([false, false]) {
                    continue;
                }
                let conditions = pair.map(|pair| pair.map(|given| if given { Condition::Given(0.0) } else { Condition::Level }));
                let line = Line::new(cells, 1.0, conditions, on_faces);
                let values: Vec<f64> = (0..line.length).map(|place| ((place * place) as f64 * 0.7).sin()).collect();
                let mut scaled = values.clone();
                let mut space = line.workspace();
                // What another line has left must not matter.
                space.real.fill(1.0);
                space.modes.fill(Mode::new(1.0, 1.0));
                space.complex.fill(Mode::new(1.0, 1.0));
                line.forward(&mut scaled, &mut space);
                space.real.fill(1.0);
                scaled.iter_mut().zip(&line.squares).for_each(|(amplitude, square)| *amplitude *= square / line.gain);
                line.backward(&mut scaled, &mut space);
                for (place, got) in scaled.iter().enumerate() {
                    let wanted =
                        2.0 * values[place] - beside(&values, place, 0, pair, on_faces) - beside(&values, place, 1, pair, on_faces);
                    assert!((got - wanted).abs() < 1e-12, "{cells} {pair:?} {on_faces} {place}: {got} {wanted}");
                }
            }
        }
    }

    /// The neighbour before (end 0) or after (end 1) a value, beyond the ends by reflection.
    fn beside(values: &[f64], place: usize, end: usize, pair: Option<[bool; 2]>, on_faces: bool) -> f64 {
        let last = values.len() - 1;
        let (at_end, across, within) = if end == 0 { (place == 0, last, 1) } else { (place == last, 0, last - 1) };
        match pair {
            _ if !at_end => values[if end == 0 { place - 1 } else { place + 1 }],
            None => values[across],
            Some(given) if on_faces => {
                if given[end] {
                    0.0
                } else {
                    values[within]
                }
            }
            Some(given) => {
                if given[end] {
                    -values[place]
                } else {
                    values[place]
                }
            }
        }
    }
}
