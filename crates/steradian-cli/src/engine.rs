//! The arguments that `render` and `measure` share: seed, threads, limits.

use std::num::NonZero;
use std::thread::available_parallelism;

use clap::{Args, ValueEnum};
use steradian_kernel::InstructionSet;

use crate::status::Failure;
use crate::values;

/// What decides how a run is carried out.
#[derive(Args, Debug)]
#[command(next_help_heading = "Computation")]
pub struct Engine {
    /// Seed of all random numbers: the same seed gives the same bits
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    pub seed: u64,
    #[command(flatten)]
    pub threads: Threads,
    /// Cut paths off after this many segments, for comparisons with programs that must; results are then too low
    #[arg(long, value_name = "NUMBER")]
    pub max_depth: Option<u32>,
    /// Compute part K of N only; -o names the file of the part, and `steradian merge` puts the parts together
    #[arg(long, value_name = "K/N", value_parser = values::shard, requires = "output")]
    pub shard: Option<(u32, u32)>,
    /// Instruction set of the inner loops; has no influence on the result
    #[arg(long, value_enum, value_name = "SET", default_value_t)]
    instruction_set: Set,
}

/// How many threads.
#[derive(Args, Clone, Copy, Debug)]
pub struct Threads {
    /// Threads; has no influence on the result [default: as many as the machine runs at once]
    #[arg(long, value_name = "NUMBER")]
    threads: Option<NonZero<usize>>,
}

impl Threads {
    /// The number asked for, or that of the machine.
    pub fn count(self) -> usize {
        self.threads
            .or_else(|| available_parallelism().ok())
            .map_or(1, NonZero::get)
    }
}

/// Instruction sets by name.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum Set {
    /// The best of this machine
    #[default]
    Auto,
    /// Without vector instructions of our own
    Scalar,
    /// AVX2 (x86-64)
    Avx2,
    /// AVX-512 (x86-64)
    Avx512,
}

impl Engine {
    /// The instruction set, if this machine has it.
    pub fn instruction_set(&self) -> Result<InstructionSet, Failure> {
        let wanted = match self.instruction_set {
            Set::Auto => InstructionSet::detect(),
            Set::Scalar => InstructionSet::Scalar,
            Set::Avx2 => InstructionSet::Avx2,
            Set::Avx512 => InstructionSet::Avx512,
        };
        if InstructionSet::available().contains(&wanted) {
            return Ok(wanted);
        }
        Err(Failure::message(format!(
            "this machine does not have {wanted:?}"
        )))
    }
}
