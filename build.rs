//! Tells the command how it was built: what a measurement was made with belongs beside it.

use std::env;
use std::process::Command;

fn main() {
    let rustc = env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version =
        Command::new(rustc).arg("--version").output().ok().and_then(|output| String::from_utf8(output.stdout).ok());
    say("RUSTC", version.as_deref().map_or("unknown", str::trim));
    say("OPT_LEVEL", &env::var("OPT_LEVEL").unwrap_or_default());
    let flags = env::var("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default();
    let cpu = flags.split('\u{1f}').find_map(|flag| flag.trim_start_matches("-C").strip_prefix("target-cpu="));
    say("TARGET_CPU", cpu.unwrap_or("baseline"));
    say("TARGET", &env::var("TARGET").unwrap_or_default());
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=RUSTFLAGS");
}

fn say(name: &str, value: &str) {
    println!("cargo::rustc-env=CHOQUE_{name}={value}");
}
