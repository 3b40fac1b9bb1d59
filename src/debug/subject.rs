//! What can be debugged.

use super::given::Given;
#[cfg(feature = "scene")]
use super::pixel::{PixelSubject, VertexSubject};
use super::record::{Edit, Invocation, record};
use super::run::{Listing, Run, RunKind};
use super::session::Position;
use crate::exec::{Environment, bind_constants};

/// What is debugged.
#[derive(Clone, Debug)]
pub enum Subject<'a> {
    /// A listing with values set by hand.
    Listing(ListingSubject<'a>),
    /// A pixel of a scene.
    #[cfg(feature = "scene")]
    Pixel(PixelSubject<'a>),
    /// A vertex of a scene.
    #[cfg(feature = "scene")]
    Vertex(VertexSubject<'a>),
}

/// A listing with values set by hand. No texture is bound: a sample is opaque black, as Direct3D 8 had it.
#[derive(Clone, Debug)]
pub struct ListingSubject<'a> {
    /// The listing.
    pub listing: Listing<'a>,
    /// The values.
    pub given: Given,
}

impl<'a> Subject<'a> {
    /// Records every run of the subject, with values that are set on the way.
    pub fn record(&self, edits: &[Edit]) -> Vec<Run<'a>> {
        match self {
            Self::Listing(subject) => vec![subject.record(edits)],
            #[cfg(feature = "scene")]
            Self::Pixel(subject) => subject.record(edits),
            #[cfg(feature = "scene")]
            Self::Vertex(subject) => subject.record(edits),
        }
    }

    /// Where a session begins: at the first instruction of the last run.
    pub fn start(&self, runs: &[Run<'a>]) -> Position {
        let run = runs.len().saturating_sub(1);
        let at = runs.get(run).map_or(0, Run::first_instruction);
        Position { run, at }
    }
}

impl<'a> ListingSubject<'a> {
    fn record(&self, edits: &[Edit]) -> Run<'a> {
        let kernel = self.listing.kernel;
        let invocation = Invocation {
            kind: RunKind::Listing,
            listing: self.listing,
            environment: Environment {
                constants: bind_constants(kernel, &self.given.constants),
                ..Environment::default()
            },
            lane: 0,
            helpers: [false; 4],
            inputs: self.given.inputs(kernel),
        };
        record(invocation, edits)
    }
}
