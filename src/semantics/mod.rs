//! What each step of a kernel computes: the only place with arithmetic meaning on the CPU.
//!
//! Every function here works on plain numbers, has no state and takes no branch that depends on more than its
//! arguments, so that an executor may call it for one invocation or in a loop over many lanes and get the same bits.
//! Rust never contracts `a * b + c`, so the bits are the same on every target as well.
//!
//! Numbers are 32-bit floats, of which a hardware model may allow fewer ([`held`], [`operand`]). Two rules of the shader model hold everywhere: a product with a factor of zero is
//! +0, whatever the other factor is ([`mul`], unless [`Products`] are others), and denormal results are flushed to zero ([`Finish`]).

mod modify;
mod scalar;
mod vector;

#[cfg(test)]
mod tests;

pub use modify::{Finish, address, constant, flush, held, modify, operand};
pub use scalar::*;
pub use vector::*;
