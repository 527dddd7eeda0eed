//! A test per scenario, pinned by its snapshot.

fn main() -> std::process::ExitCode {
    choque::harness::main!()
}
