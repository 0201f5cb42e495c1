//! What every scene may rely on: bitwise restart, independence of the order of bodies, conservation, and that what is left out costs nothing.

mod shaped;
mod spheres;
