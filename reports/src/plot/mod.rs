//! Plots as inline SVG, drawn through plotters and coloured by the page.

mod axis;
pub(crate) mod bars;
mod canvas;
pub(crate) mod convergence;
pub(crate) mod cost;
pub(crate) mod curves;
pub(crate) mod figure;
mod layer;
mod marker;
mod panel;
pub(crate) mod slices;

pub(crate) use canvas::DrawError;
