//! The command `choque`; everything it does is in the library beside it.

use std::process::ExitCode;

fn main() -> ExitCode {
    choque::cli::main()
}
