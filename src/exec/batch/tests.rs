//! Batches against machines: the same bits, for every number of lanes and every set of instructions.

use super::*;
use crate::diagnostic::SourceMap;
use crate::exec::{Machine, bind_constants};
use crate::generate::{self, Options, Random, Textures};
use crate::isa::Version;
use crate::kernel::{self, Kernel, Plan, lower};
use crate::policy::{Model, OfZero, Policies, ZeroProduct};
use crate::syntax;
