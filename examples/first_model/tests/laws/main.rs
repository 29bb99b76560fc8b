//! Laws that every model obeys, one file each: `docs/tests_to_copy.md` shows them.

mod derivatives;
mod energy;
mod mass_matrix;
mod payload;
mod round_trip;
mod skew;
mod textbook;
