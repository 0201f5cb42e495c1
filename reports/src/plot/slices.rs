//! Round bodies in a slice at several times: one small picture for each time.

use maud::{Markup, html};

use crate::curve_file::read_table;
use crate::{CaseResults, number};

/// Width of a picture in its own pixels.
const WIDTH: f64 = 190.0;
/// How dark a body at rest is, the fastest being 1.
const AT_REST: f64 = 0.12;

/// A body: place across, height, speed.
type Body = [f64; 3];

/// Bodies at the same time.
struct Slice {
    time: f64,
    bodies: Vec<Body>,
}

/// Sets the pictures under their title, or says why there are none.
pub(crate) fn figure(case: &CaseResults, [title, file, caption]: [&str; 3], radius: f64, command: &str) -> Markup {
    let slices = case.file(file).ok_or_else(|| format!("the file {file} is missing")).and_then(read);
    html! {
        figure.plot {
            h3 { (title) }
            @match slices {
                Err(reason) => p.missing { "Not drawn: " (reason) "." },
                Ok(slices) => {
                    @let fit = Fit::new(&slices, radius);
                    div.slices { @for slice in &slices { (fit.draw(slice, slices.len() > 1)) } }
                    figcaption {
                        span { (caption) } " "
                        span.links { a href=(format!("data/{file}")) { "data" } " · remake: " code { (command) } }
                    }
                },
            }
        }
    }
}

fn read(text: &str) -> Result<Vec<Slice>, String> {
    let table = read_table(text)?;
    let [time, across, height, speed] = ["time", "across", "height", "speed"].map(|name| table.column(name));
    let (time, columns) = (time?, [across?, height?, speed?]);
    let mut slices: Vec<Slice> = Vec::new();
    for row in table.rows.iter().filter(|row| row.iter().all(|value| value.is_finite())) {
        let body = columns.map(|column| row[column]);
        match slices.last_mut().filter(|slice| slice.time == row[time]) {
            Some(slice) => slice.bodies.push(body),
            None => slices.push(Slice { time: row[time], bodies: vec![body] }),
        }
    }
    if slices.is_empty() { Err("there are no bodies in the file".into()) } else { Ok(slices) }
}

/// From lengths to pixels, the same for all pictures.
struct Fit {
    low: [f64; 2],
    high: [f64; 2],
    scale: f64,
    radius: f64,
    fastest: f64,
}

impl Fit {
    fn new(slices: &[Slice], radius: f64) -> Fit {
        let bodies = || slices.iter().flat_map(|slice| &slice.bodies);
        let least = |axis: usize| bodies().map(|body| body[axis]).fold(f64::INFINITY, f64::min) - radius;
        let most = |axis: usize| bodies().map(|body| body[axis]).fold(f64::NEG_INFINITY, f64::max) + radius;
        let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
        let fastest = bodies().map(|body| body[2]).fold(f64::MIN_POSITIVE, f64::max);
        Fit { low, high, scale: WIDTH / (high[0] - low[0]), radius, fastest }
    }

    /// One picture, with its time where there are others.
    fn draw(&self, slice: &Slice, is_timed: bool) -> Markup {
        let tenth = |pixels: f64| (10.0 * pixels).round() / 10.0;
        let (across, down) = (|x: f64| tenth((x - self.low[0]) * self.scale), |y: f64| tenth((self.high[1] - y) * self.scale));
        let at = if is_timed { format!(" at {} s", number::terminal(slice.time)) } else { String::new() };
        let words = format!("{} bodies{at}", slice.bodies.len());
        let shade = |speed: f64| tenth(10.0 * (AT_REST + (1.0 - AT_REST) * (speed / self.fastest).sqrt())) / 10.0;
        html! {
            figure {
                svg.slice viewBox=(format!("0 0 {WIDTH} {}", down(self.low[1]))) role="img" {
                    title { (words) }
                    @for [x, y, speed] in &slice.bodies {
                        circle cx=(across(*x)) cy=(down(*y)) r=(tenth(self.radius * self.scale)) fill-opacity=(shade(*speed)) {}
                    }
                }
                @if is_timed { figcaption { (number::short(slice.time)) " s" } }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_of_a_time_are_one_picture_in_one_frame() {
        let slices = read("time,across,height,speed\n0,1,2,0\n0,3,2,0\n5,2,1,4\n").expect("a well-formed file");
        assert_eq!(slices.iter().map(|slice| (slice.time, slice.bodies.len())).collect::<Vec<_>>(), [(0.0, 2), (5.0, 1)]);
        let fit = Fit::new(&slices, 1.0);
        // Four wide and three high.
        let [first, second] = [0, 1].map(|index| fit.draw(&slices[index], true).into_string());
        assert!(first.contains("viewBox=\"0 0 190 142.5\"") && first.matches("<circle").count() == 2, "{first}");
        assert!(first.contains("cx=\"47.5\" cy=\"47.5\" r=\"47.5\" fill-opacity=\"0.12\""), "{first}");
        assert!(second.contains("bodies at 5.0 s") && !fit.draw(&slices[1], false).into_string().contains("5.0"), "{second}");
        assert!(second.contains("cx=\"95\" cy=\"95\"") && second.contains("fill-opacity=\"1\""), "{second}");
    }

    #[test]
    fn what_is_missing_is_said() {
        assert_eq!(read("time,across,height\n0,1,2\n").err(), Some("there is no column \"speed\"".into()));
        assert_eq!(read("time,across,height,speed\n").err(), Some("there are no bodies in the file".into()));
    }
}
