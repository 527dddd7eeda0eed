//! This repository's own snapshots.

use std::path::Path;

use choque::harness::unreferenced;

#[test]
fn every_snapshot_has_its_scenario() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let orphans = unreferenced(package).expect("the folders can be read");
    assert!(orphans.is_empty(), "no scenario is pinned by these any more; delete them: {orphans:#?}");
}
