//! The raster room (to be filled).
