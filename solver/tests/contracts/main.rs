//! What every scene may rely on: bitwise restart, independence of the order of bodies, conservation, and that what is left out costs nothing.

mod elastic_and_rolling;
mod hard;
mod impulse;
mod moving_walls;
mod neighbours;
mod openings;
mod shaped;
mod shaped_friction;
mod spheres;
mod superellipsoids;
mod walls;
mod walls_and_insertion;
