//! Markers: the shape of a point, so that series differ without colour too.

use super::canvas::{Canvas, DrawError, Ink, Pixel, SERIES_INKS};

/// How a series looks: its ink, its shape, filled or hollow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Look {
    pub(crate) ink: Ink,
    shape: Shape,
    hollow: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Disc,
    /// Number of corners, and the angle of the first one from the top in degrees.
    Regular(u8, u16),
    /// A star with this many rays drawn as strokes: only other codes wear it.
    Rays(u8),
}

const SHAPES: [Shape; 7] = [
    Shape::Disc,
    Shape::Regular(4, 45),
    Shape::Regular(3, 0),
    Shape::Regular(4, 0),
    Shape::Regular(3, 180),
    Shape::Regular(5, 0),
    Shape::Regular(6, 30),
];

/// Radius of a marker in pixels.
const RADIUS: f64 = 4.6;

impl Look {
    /// The look of the series with this index in its plot. Colours and shapes have different counts, so 56 differ.
    pub(crate) fn own(index: usize) -> Look {
        Look { ink: Ink::Series(index % SERIES_INKS), shape: SHAPES[index % SHAPES.len()], hollow: false }
    }

    /// The look of another code's series.
    pub(crate) fn foreign(index: usize) -> Look {
        Look { ink: Ink::Series(SERIES_INKS - 1 - index % SERIES_INKS), shape: Shape::Rays([6, 4, 5, 3, 8][index % 5]), hollow: false }
    }

    /// The same look, hollow: a second statistic of the same series.
    pub(crate) fn hollow(self) -> Look {
        Look { hollow: true, ..self }
    }

    /// Draws the marker.
    pub(crate) fn draw(self, canvas: &Canvas, at: Pixel) -> Result<(), DrawError> {
        match self.shape {
            Shape::Disc => {
                canvas.disc(at, RADIUS, self.ink)?;
                if self.hollow { canvas.disc(at, RADIUS - 1.5, Ink::Surface) } else { Ok(()) }
            }
            Shape::Regular(corners, degrees) => {
                canvas.polygon(&regular(at, corners, degrees, RADIUS * 1.18), self.ink)?;
                let inner = RADIUS * 1.18 - if corners == 3 { 3.0 } else { 2.0 };
                if self.hollow { canvas.polygon(&regular(at, corners, degrees, inner), Ink::Surface) } else { Ok(()) }
            }
            Shape::Rays(rays) => regular(at, rays, 0, RADIUS * 1.4).into_iter().try_for_each(|tip| canvas.line(&[at, tip], self.ink, 1.8)),
        }
    }
}

/// Draws the cross of a failed run.
pub(crate) fn failure_cross(canvas: &Canvas, [x, y]: Pixel) -> Result<(), DrawError> {
    let reach = 5.0;
    canvas.line(&[[x - reach, y - reach], [x + reach, y + reach]], Ink::Bad, 2.4)?;
    canvas.line(&[[x - reach, y + reach], [x + reach, y - reach]], Ink::Bad, 2.4)
}

fn regular([x, y]: Pixel, corners: u8, degrees: u16, radius: f64) -> Vec<Pixel> {
    (0..corners)
        .map(|corner| {
            let angle = (f64::from(degrees) + 360.0 * f64::from(corner) / f64::from(corners)).to_radians();
            [x + radius * angle.sin(), y - radius * angle.cos()]
        })
        .collect()
}
