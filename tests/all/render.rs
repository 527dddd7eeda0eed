//! Pictures of runs: what they are made of, and what is refused.

use std::fs;

use crate::support::{choque, folder, stderr};

const MEETING: &str = "title(\"A <meeting>\"); time_step(1.0 / 64); steps(64); let speed = param(\"speed\", 3);
    fixed(\"floor\").rect(400, 1).at(0, -3);
    mobile(\"a\").rect(1, 1).at(-2, 0).velocity(speed, 0); mobile(\"b\").rect(1, 2).at(0.5, 0.1);";

#[test]
fn a_run_becomes_what_the_extension_says() {
    let folder = folder(&[("scene.rhai", MEETING)]);
    let call = |words: &str| choque().current_dir(folder.path()).args(words.split(' ')).output().expect("it runs");
    let file = |name: &str| fs::read(folder.path().join(name)).expect("a file");
    for words in [
        "run scene.rhai --record run.choque",
        "export scene.rhai -o scene.ron",
        "render scene.rhai -o a.svg",
        "render scene.ron -o b.svg",
        "render run.choque -o c.svg",
        "render scene.rhai -o early.svg --at 0.25",
        "render scene.rhai -o too.svg --iteration 16",
        "render scene.rhai -o slow.svg --set speed=0.5",
        "render run.choque -o a.png --width 300",
        "render run.choque -o a.gif --width 200 --fps 10",
    ] {
        let output = call(words);
        assert_eq!(output.status.code(), Some(0), "{words}: {}", stderr(&output));
    }
    let svg = String::from_utf8(file("a.svg")).expect("text");
    let document = roxmltree::Document::parse(&svg).expect("well-formed");
    assert!(document.descendants().any(|node| node.text() == Some("A <meeting> at iteration 64")), "{svg}");
    // White under all of it: on a dark page too names and trails are seen.
    let first = document.descendants().find(|node| node.has_tag_name("path")).expect("shapes");
    let page = ["width", "height"].map(|side| document.root_element().attribute(side).expect("a size"));
    let all_of_it = format!("m0 0l{} 0l0 {}l-{} 0z", page[0], page[1], page[0]);
    assert_eq!((first.attribute("fill"), first.attribute("d")), (Some("#ffffff"), Some(all_of_it.as_str())));
    assert_eq!(file("a.svg"), file("c.svg"), "a recording looks as the run does");
    assert_eq!(file("early.svg"), file("too.svg"));
    assert_ne!(file("early.svg"), file("a.svg"));
    assert_ne!(file("slow.svg"), file("a.svg"));
    assert_eq!(file("a.png")[..4], *b"\x89PNG");
    let moving = file("a.gif");
    let mut pictures = gif::Decoder::new(moving.as_slice()).expect("a GIF");
    let (wide, mut count) = (pictures.width(), 0);
    while pictures.read_next_frame().expect("a whole one").is_some() {
        count += 1;
    }
    assert_eq!((wide, count), (200, 11), "a second of ten pictures, and the end");
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let folder = folder(&[("scene.rhai", MEETING), ("bad.choque", "\u{89}choq")]);
    for (words, said) in [
        ("render scene.rhai -o picture.jpg", "its extension says what is made"),
        ("render scene.rhai -o a.svg --at 2", "it ends at iteration 64, at 1 s"),
        ("render scene.rhai -o a.svg --iteration 65", "--iteration 65 is not in the run"),
        ("render scene.rhai -o a.gif --at 0.5", "shows all of a run"),
        ("render bad.choque -o a.svg", "cannot read bad.choque: byte 0: it does not begin as a recording does"),
        ("render none.choque -o a.svg", "cannot read none.choque"),
        ("render scene.rhai -o none/a.svg", "in a folder that is not there"),
        ("render scene.rhai -o none/a.svg", "make the folder none first"),
    ] {
        let output = choque().current_dir(folder.path()).args(words.split(' ')).output().expect("it runs");
        assert_eq!(output.status.code(), Some(2), "{words}");
        assert!(stderr(&output).contains(said), "{words}: {}", stderr(&output));
    }
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 2, "nothing is left");
}
