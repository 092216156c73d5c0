//! Results out: tables, JSON, CSV and Parquet of readings; EXR, PFM, HDR and PNG pictures; SVG diagrams; shards. JSON in again.
//!
//! Every encoder turns a result into bytes or text and touches no file; [`write_atomically`] puts bytes under a name in
//! one step, so that a run that stops half-way leaves no half-written output. The same result gives the same bytes.

pub mod atomic;
mod balance;
pub mod columns;
pub mod csv;
pub mod error;
pub mod exr;
pub mod false_colour;
pub mod figure;
pub mod form_factors;
pub mod glyphs;
pub mod hdr;
pub mod html;
pub mod image;
pub mod json;
pub mod npz;
pub mod numbers;
#[cfg(feature = "parquet")]
pub mod parquet;
pub mod pfm;
pub mod picture_file;
pub mod plot;
pub mod png;
mod raster;
pub mod rows;
pub mod run;
pub mod shard;
pub mod solution;
mod spool;
pub mod stored;
pub mod stream;
pub mod svg;
pub mod table;
pub mod tone;

pub use atomic::{AtomicFile, write_atomically};
pub use error::ReportError;
pub use image::{Channel, ImageFacts, PixelQuantity, RadianceImage};
pub use picture_file::{Look, PictureFormat};
pub use run::Run;
pub use shard::Shard;
pub use stored::StoredRun;
pub use stream::{Stream, StreamFacts, StreamFormat, Verdict};
