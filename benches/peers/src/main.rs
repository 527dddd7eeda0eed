//! The command: see `choque_peers::cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    choque_peers::cli::main()
}
