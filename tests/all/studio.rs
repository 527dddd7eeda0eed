//! The studio as a server, asked without a browser: what it answers, what it refuses, what it does to files.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::support::{choque, folder};

/// How long anything may take before a test gives up.
const PATIENCE: Duration = Duration::from_secs(30);

const BALL: &str = "// A ball meets a wall.
import \"lib/walls\" as w;
mu_l(0.5); // half of it\r
let speed = param(\"speed\", 4, 0, 10);
let tilt = param(\"tilt\", 0.25);
steps(100);
w::wall();
mobile(\"ball\").rect(1, 1).at(-3, tilt).velocity(speed, 0);
print(\"made\");
expect(\"it stays this side\", |world| world[\"ball\"].x < 2);
";
const WALLS: &str = "fn wall() { fixed(\"wall\").rect(1, 8).at(2, 0); }";

/// A studio of its own over a folder of its own, ended with the test.
struct Studio {
    process: Child,
    folder: TempDir,
    port: u16,
    token: String,
}

/// An answer: its status, its head in lower case, its body.
struct Answer {
    status: u16,
    head: String,
    body: Vec<u8>,
}

/// What a run said: events, and how many bytes of films came, in order.
struct Told {
    events: Vec<Value>,
    films: Vec<Vec<u8>>,
}

impl Studio {
    fn open(files: &[(&str, &str)], flags: &[&str]) -> Studio {
        let folder = folder(files);
        let mut command = choque();
        command.current_dir(folder.path()).arg("studio").args(flags).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut process = command.spawn().expect("the command can be started");
        let mut address = String::new();
        BufReader::new(process.stdout.take().expect("a pipe")).read_line(&mut address).expect("an address");
        let rest = address.trim().strip_prefix("http://127.0.0.1:").unwrap_or_else(|| panic!("{address}"));
        let (port, token) = rest.trim_end_matches('/').split_once('/').expect("a token");
        let port = port.parse().expect("a port");
        Studio { process, folder, port, token: token.to_owned() }
    }

    fn with_ball() -> Studio {
        Studio::open(&[("scenarios/ball.rhai", BALL), ("scenarios/lib/walls.rhai", WALLS)], &[])
    }

    fn path(&self, name: &str) -> String {
        format!("/{}/{name}", self.token)
    }

    fn host(&self) -> String {
        format!("Host: 127.0.0.1:{}", self.port)
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("the studio listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a time");
        stream
    }

    /// Sends a request as it is and gives the whole answer.
    fn raw(&self, line: &str, headers: &[&str], body: &str) -> Answer {
        let mut stream = self.connect();
        stream.write_all(request(line, headers, body).as_bytes()).expect("it can be asked");
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).expect("an answer");
        Answer::of(&bytes)
    }

    fn get(&self, name: &str) -> Answer {
        self.raw(&format!("GET {} HTTP/1.1", self.path(name)), &[&self.host()], "")
    }

    fn post(&self, name: &str, question: &Value) -> Answer {
        let line = format!("POST {} HTTP/1.1", self.path(name));
        self.raw(&line, &[&self.host(), "Content-Type: application/json"], &question.to_string())
    }

    fn run(&self, scenario: &str, set: &Value) -> Told {
        let answer = self.post("run", &json!({ "scenario": scenario, "set": set }));
        assert_eq!(answer.status, 200, "{}", answer.text());
        Told::of(&answer.body)
    }

    fn save(&self, digest: &Value, set: &Value) -> Answer {
        self.post("save", &json!({ "scenario": "ball.rhai", "digest": digest, "set": set }))
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.folder.path().join(file)).expect("a text")
    }

    fn write(&self, file: &str, text: &str) {
        fs::write(self.folder.path().join(file), text).expect("a file");
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn request(line: &str, headers: &[&str], body: &str) -> String {
    let headers: String = headers.iter().map(|header| format!("{header}\r\n")).collect();
    format!("{line}\r\n{headers}Connection: close\r\nContent-Length: {}\r\n\r\n{body}", body.len())
}

impl Answer {
    fn of(bytes: &[u8]) -> Answer {
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").expect("a head");
        let head = String::from_utf8_lossy(&bytes[..end]).to_lowercase();
        let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status");
        let rest = &bytes[end + 4..];
        let body = if head.contains("transfer-encoding: chunked") { joined(rest) } else { rest.to_vec() };
        Answer { status, head, body }
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }
}

/// The content of a body that was sent in chunks.
fn joined(mut rest: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    while let Some(end) = rest.windows(2).position(|two| two == b"\r\n") {
        let length = usize::from_str_radix(&String::from_utf8_lossy(&rest[..end]), 16).expect("a length");
        body.extend_from_slice(&rest[end + 2..end + 2 + length]);
        rest = &rest[end + 2 + length + 2..];
    }
    body
}

impl Told {
    fn of(mut body: &[u8]) -> Told {
        let (mut events, mut films) = (Vec::new(), Vec::new());
        while let [kind, a, b, c, d, rest @ ..] = body {
            let (content, after) = rest.split_at(u32::from_le_bytes([*a, *b, *c, *d]) as usize);
            match kind {
                b'J' => events.push(serde_json::from_slice(content).expect("JSON")),
                b'F' => films.push(content.to_vec()),
                other => panic!("{other} is no kind"),
            }
            body = after;
        }
        Told { events, films }
    }

    fn event(&self, name: &str) -> &Value {
        let found = self.events.iter().find(|event| event["event"] == name);
        found.unwrap_or_else(|| panic!("no {name} among {:#?}", self.events))
    }
}

fn slider<'a>(scene: &'a Value, name: &str) -> &'a Value {
    let sliders = scene["sliders"].as_array().expect("sliders");
    sliders.iter().find(|slider| slider["name"] == name).unwrap_or_else(|| panic!("no {name} in {sliders:#?}"))
}

#[test]
fn scenarios_are_listed_and_what_they_import_is_not() {
    let studio = Studio::with_ball();
    studio.write("scenarios/.hidden.rhai", "");
    studio.write("scenarios/scene.ron", "");
    studio.write("scenarios/plan.ron", "Sweep(scenarios: [])");
    let list = studio.get("scenarios").json();
    let (ball, scene) =
        (json!({ "id": "ball.rhai", "about": "A ball meets a wall." }), json!({ "id": "scene.ron", "about": "" }));
    assert_eq!(list["scenarios"], json!([ball, scene]));
    studio.write("scenarios/another.rhai", "");
    let longer = studio.get("scenarios").json();
    assert_eq!(longer["scenarios"][0]["id"], "another.rhai");
    assert_ne!(list["stamp"], longer["stamp"]);
}

#[test]
fn a_run_tells_what_can_be_tuned_then_its_frames_then_what_came_of_it() {
    let studio = Studio::with_ball();
    let told = studio.run("ball.rhai", &json!([]));
    let scene = told.event("scene");
    assert_eq!((&scene["steps"], &scene["bodies"], &scene["text"]), (&json!(100), &json!(2), &json!(BALL)));
    assert_eq!(slider(scene, "mu_l")["value"], 0.5);
    let speed = slider(scene, "speed");
    let of = |key: &str| speed[key].as_f64().expect("a number");
    assert_eq!(["value", "written", "min", "max", "step"].map(of), [4.0, 4.0, 0.0, 10.0, 1.0]);
    assert_eq!(slider(scene, "tilt")["max"], 0.5, "a range that makes sense, where the script gives none");
    assert_eq!(told.event("printed")["lines"], json!(["made"]));
    let outcome = &told.event("done")["outcome"];
    assert_eq!(outcome["expectations"][0]["held"], true);
    let bytes = told.films.last().expect("a film");
    assert!(bytes.len() > 100, "{}", bytes.len());
}

#[test]
fn numbers_are_those_of_the_command() {
    let studio = Studio::with_ball();
    let told = studio.run("ball.rhai", &json!([["speed", 7.5], ["mu_l", 0.9]]));
    let arguments = ["run", "scenarios/ball.rhai", "--set", "speed=7.5", "--set", "mu_l=0.9", "--format", "json"];
    let run = choque().current_dir(studio.folder.path()).args(arguments).output().expect("it runs");
    let run: Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!(told.event("done")["outcome"]["digest"], run["digest"]);
    let other = studio.run("ball.rhai", &json!([["speed", 7]]));
    assert_ne!(other.event("done")["outcome"]["digest"], run["digest"]);
}

#[test]
fn values_that_a_script_no_longer_knows_are_dropped_and_named() {
    let studio = Studio::with_ball();
    let told = studio.run("ball.rhai", &json!([["gone", 1], ["speed", 11], ["mu_a", 0.25]]));
    let scene = told.event("scene");
    assert_eq!(scene["dropped"], json!(["gone", "speed"]));
    assert_eq!(
        (slider(scene, "speed")["value"].as_f64(), slider(scene, "mu_a")["value"].as_f64()),
        (Some(4.0), Some(0.25))
    );
}

#[test]
fn errors_are_those_of_the_command_with_line_and_caret() {
    let studio = Studio::with_ball();
    studio.write("scenarios/bad.rhai", "mobile(\"a\").rect(1, 1);\nmobile(\"b\").rect(\"wide\", 1);\n");
    let told = studio.run("bad.rhai", &json!([]));
    let error = told.event("error");
    let check =
        choque().current_dir(studio.folder.path()).args(["run", "scenarios/bad.rhai"]).output().expect("it runs");
    assert_eq!(format!("{}\n", error["text"].as_str().expect("a text")), String::from_utf8_lossy(&check.stderr));
    assert!(error["line"] == 2 && error["text"].as_str().is_some_and(|text| text.contains("^^^^")), "{error}");
    assert!(told.films.is_empty());
    // An error in a callback comes after the scene, and the frames before it are no reason to hide it.
    studio.write(
        "scenarios/late.rhai",
        "mobile(\"a\").rect(1, 1);\nfn on_step(world) { if world.iteration > 5 { world.speed = 1; } }\n",
    );
    let late = studio.run("late.rhai", &json!([]));
    assert_eq!((&late.event("error")["line"], &late.event("scene")["bodies"]), (&json!(2), &json!(1)));
}

#[test]
fn saving_a_script_or_its_import_is_noticed() {
    let studio = Studio::with_ball();
    let state = || studio.post("state", &json!({ "scenario": "ball.rhai" })).json()["stamp"].clone();
    assert_eq!(state(), Value::Null, "it has not been run");
    let told = studio.run("ball.rhai", &json!([]));
    let first = told.event("scene")["stamp"].clone();
    assert_eq!(state(), first);
    studio.write("scenarios/lib/walls.rhai", &WALLS.replace('8', "9.5"));
    let second = state();
    assert_ne!(second, first);
    studio.write("scenarios/ball.rhai", "import \"lib/walls\" as w; // cut sho");
    assert_ne!(state(), second);
    // What is missing is waited for.
    studio.write("scenarios/ball.rhai", "import \"lib/later\" as l;");
    let missing = studio.run("ball.rhai", &json!([]));
    let third = missing.event("error")["stamp"].clone();
    assert_eq!(state(), third);
    studio.write("scenarios/lib/later.rhai", "");
    assert_ne!(state(), third);
}

#[test]
fn only_the_printed_address_is_answered() {
    let studio = Studio::with_ball();
    let (host, port) = (studio.host(), studio.port);
    let line = format!("GET {} HTTP/1.1", studio.path("scenarios"));
    let status = |headers: &[&str]| studio.raw(&line, headers, "").status;
    let (local, origin) = (format!("Host: localhost:{port}"), format!("Origin: http://127.0.0.1:{port}"));
    assert_eq!([status(&[&host]), status(&[&local]), status(&[&host, &origin])], [200; 3]);
    let rebound = format!("Host: evil.example:{port}");
    for refused in [
        &[rebound.as_str()][..],
        &["Host: 127.0.0.1"],
        &[&host, "Host: evil.example"],
        &[&host, "Origin: http://evil.example"],
        &[&host, "Origin: null"],
        &[&local, &origin],
        &[&host, "Sec-Fetch-Site: cross-site"],
        &[&host, "Sec-Fetch-Site: same-site"],
    ] {
        assert_eq!(status(refused), 403, "{refused:?}");
    }
    let absolute = format!("GET http://evil.example:{port}{} HTTP/1.1", studio.path("scenarios"));
    assert_eq!(studio.raw(&absolute, &[&host], "").status, 403);
    for elsewhere in ["/", "/scenarios", "/0123456789abcdef0123456789abcdef/", &format!("/{}x/", studio.token)] {
        let answer = studio.raw(&format!("GET {elsewhere} HTTP/1.1"), &[&host], "");
        assert_eq!(answer.status, 404, "{elsewhere}");
        assert!(!answer.text().contains(&studio.token));
    }
}

#[test]
fn every_answer_keeps_the_page_to_itself() {
    let studio = Studio::with_ball();
    let refused = studio.raw("GET / HTTP/1.1", &["Host: evil.example"], "");
    for answer in [studio.get(""), studio.get("studio.js"), studio.get("scenarios"), studio.get("nothing"), refused] {
        assert!(
            answer.head.contains("content-security-policy: default-src 'none'; script-src 'self';"),
            "{}",
            answer.head
        );
        assert!(answer.head.contains("x-content-type-options: nosniff") && !answer.head.contains("access-control"));
    }
    let page = studio.get("").text();
    for file in page.split("=\"").skip(1).filter_map(|rest| rest.split('"').next()).filter(|name| name.ends_with("js"))
    {
        assert_eq!(studio.get(file).status, 200, "{file}");
    }
    assert!(!page.contains("://") && !page.contains("style=\"") && !page.contains("<script>"), "{page}");
}

#[test]
fn questions_that_are_none_are_refused() {
    let studio = Studio::with_ball();
    let ask = |body: &str, kind: &str| {
        let line = format!("POST {} HTTP/1.1", studio.path("run"));
        studio.raw(&line, &[&studio.host(), &format!("Content-Type: {kind}")], body).status
    };
    let good = "{\"scenario\": \"ball.rhai\", \"set\": []}";
    assert_eq!(ask(good, "application/json"), 200);
    assert_eq!(ask(good, "text/plain"), 415, "what a form of another site could send");
    for bad in [
        "",
        "{}",
        "[1",
        "{\"scenario\": 1, \"set\": []}",
        "{\"scenario\": \"ball.rhai\", \"set\": [[\"speed\", 1e999]]}",
    ] {
        assert_eq!(ask(bad, "application/json"), 400, "{bad}");
    }
    let long = format!("{{\"scenario\": \"{}\", \"set\": []}}", "x".repeat(300_000));
    assert_eq!(ask(&long, "application/json"), 413);
    assert_eq!(studio.get("run").status, 405);
}

#[test]
fn no_name_leads_out_of_the_folder() {
    let studio = Studio::with_ball();
    studio.write("secret.rhai", "mobile(\"a\").rect(1, 1);");
    let absolute = studio.folder.path().join("secret.rhai").display().to_string();
    for name in [
        "../secret.rhai",
        "./../secret.rhai",
        "a/../../secret.rhai",
        &absolute,
        "..\\secret.rhai",
        "",
        ".",
        "lib",
        "ball",
    ] {
        assert_eq!(studio.post("run", &json!({ "scenario": name, "set": [] })).status, 404, "{name}");
        assert_eq!(studio.post("save", &json!({ "scenario": name, "digest": "", "set": [] })).status, 404, "{name}");
    }
    for path in ["../scenarios", "..%2f..%2fsecret.rhai", "%2e%2e/secret.rhai"] {
        assert_eq!(studio.get(path).status, 404, "{path}");
    }
}

#[test]
fn a_script_without_end_is_stopped_and_the_studio_lives() {
    let endless = "mobile(\"a\").rect(1, 1);\nfn on_step(world) { loop { } }";
    let flags = ["--script-timeout", "0.02"];
    let studio = Studio::open(&[("scenarios/endless.rhai", endless), ("scenarios/main.rhai", "loop { }")], &flags);
    for name in ["endless.rhai", "main.rhai"] {
        let told = studio.run(name, &json!([]));
        assert!(told.event("error")["text"].as_str().is_some_and(|text| text.contains("0.02 s")), "{:?}", told.events);
    }
    assert_eq!(studio.get("scenarios").status, 200);
}

#[test]
fn a_run_without_end_is_stopped_and_told_so() {
    let long = "steps(1000000000);\nmobile(\"a\").rect(1, 1).spin(1);";
    let studio = Studio::open(&[("scenarios/long.rhai", long)], &["--run-timeout", "0.3"]);
    let told = studio.run("long.rhai", &json!([]));
    let text = told.event("error")["text"].as_str().expect("a text").to_owned();
    assert!(text.contains("more than 0.3 s") && text.contains("--run-timeout"), "{text}");
    assert!(!told.films.is_empty(), "what was there by then has been shown");
}

#[test]
fn runs_that_nobody_waits_for_any_more_make_room() {
    let files = [("scenarios/ball.rhai", "mobile(\"a\").rect(1, 1);"), ("scenarios/endless.rhai", "loop { }")];
    let studio = Studio::open(&files, &["--script-timeout", "1000", "--run-timeout", "1000"]);
    // More of them than there are places; each page goes away before its answer.
    for _ in 0..20 {
        let mut page = studio.connect();
        let question = json!({ "scenario": "endless.rhai", "set": [] }).to_string();
        let line = format!("POST {} HTTP/1.1", studio.path("run"));
        let asked = request(&line, &[&studio.host(), "Content-Type: application/json"], &question);
        page.write_all(asked.as_bytes()).expect("it can be asked");
        page.set_read_timeout(Some(Duration::from_millis(20))).expect("a time");
        let _ = page.read(&mut [0]);
    }
    studio.run("ball.rhai", &json!([])).event("done"); // within the time that an answer is waited for
}

#[test]
fn many_pages_ask_at_once() {
    let studio = Studio::with_ball();
    let digest = |speed: usize| {
        let told = studio.run("ball.rhai", &json!([["speed", speed % 5]]));
        told.event("done")["outcome"]["digest"].to_string()
    };
    let digests: Vec<String> = std::thread::scope(|scope| {
        let asked: Vec<_> = (0..20).map(|speed| scope.spawn(move || digest(speed))).collect();
        asked.into_iter().map(|page| page.join().expect("an answer")).collect()
    });
    for (speed, found) in digests.iter().enumerate() {
        assert_eq!(*found, digests[speed % 5]);
        assert!(speed % 5 == 0 || *found != digests[0]);
    }
}

#[test]
fn sliders_are_written_into_the_script_and_nothing_else_is_touched() {
    let studio = Studio::with_ball();
    let before = studio.run("ball.rhai", &json!([["mu_l", 0.75], ["speed", 6.5], ["mu_a", 0.125], ["tilt", -1]]));
    let set = json!([["mu_l", 0.75], ["speed", 6.5], ["mu_a", 0.125], ["tilt", -1]]);
    let saved = studio.save(&before.event("scene")["digest"], &set);
    assert_eq!(saved.status, 200, "{}", saved.text());
    let expected = BALL
        .replace("mu_l(0.5); // half of it\r\n", "mu_l(0.75); // half of it\r\nmu_a(0.125);\r\n")
        .replace("\"speed\", 4,", "\"speed\", 6.5,")
        .replace("0.25", "-1.0");
    assert_eq!(studio.read("scenarios/ball.rhai"), expected);
    let after = studio.run("ball.rhai", &json!([]));
    assert_eq!(after.event("done")["outcome"]["digest"], before.event("done")["outcome"]["digest"]);
    assert_eq!(after.event("scene")["digest"], saved.json()["digest"]);
    assert_eq!(
        fs::read_dir(studio.folder.path().join("scenarios")).expect("a folder").count(),
        2,
        "nothing lies beside it"
    );
}

#[test]
fn a_script_that_changed_meanwhile_is_not_written() {
    let studio = Studio::with_ball();
    let digest = studio.run("ball.rhai", &json!([])).event("scene")["digest"].clone();
    let edited = BALL.replace("half of it", "my own words");
    studio.write("scenarios/ball.rhai", &edited);
    let refused = studio.save(&digest, &json!([["mu_l", 0.75]]));
    assert!(refused.status == 409 && refused.text().contains("changed on disk"), "{}", refused.text());
    assert_eq!(studio.read("scenarios/ball.rhai"), edited);
}

#[test]
fn a_number_that_cannot_be_placed_is_shown_and_left() {
    let twice = "mu_l(0.5);\nmu_l(0.6);\nmobile(\"a\").rect(1, 1);\n";
    let studio = Studio::open(&[("scenarios/ball.rhai", twice)], &[]);
    let digest = studio.run("ball.rhai", &json!([])).event("scene")["digest"].clone();
    let refused = studio.save(&digest, &json!([["mu_l", 0.75]]));
    let text = refused.json()["error"].as_str().expect("a text").to_owned();
    assert!(refused.status == 409 && text.contains("ball.rhai:1:1") && text.contains("2 times (line 1, 2)"), "{text}");
    assert_eq!(studio.read("scenarios/ball.rhai"), twice);
}

#[test]
fn pages_that_write_at_once_lose_nothing() {
    let studio = Studio::with_ball();
    let digest = studio.run("ball.rhai", &json!([])).event("scene")["digest"].clone();
    let write = |value: f64| studio.save(&digest, &json!([["mu_l", value]])).status;
    let statuses: Vec<u16> = std::thread::scope(|scope| {
        let pages: Vec<_> = (1..=6).map(|page| scope.spawn(move || write(f64::from(page) / 8.0 + 0.01))).collect();
        pages.into_iter().map(|page| page.join().expect("an answer")).collect()
    });
    assert_eq!(statuses.iter().filter(|status| **status == 200).count(), 1, "{statuses:?}");
    assert_eq!(statuses.iter().filter(|status| **status == 409).count(), 5, "{statuses:?}");
    let found = studio.read("scenarios/ball.rhai");
    assert_eq!(found.lines().count(), BALL.lines().count());
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay_and_read_only_scripts_are_left() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let studio = Studio::open(&[("scenarios/lib/real.rhai", "mu_l(0.5);\nmobile(\"a\").rect(1, 1);\n")], &[]);
    let (real, link) =
        (studio.folder.path().join("scenarios/lib/real.rhai"), studio.folder.path().join("scenarios/ball.rhai"));
    symlink(&real, &link).expect("a link");
    let mode = |path: &Path| fs::metadata(path).expect("a file").permissions().mode() & 0o777;
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).expect("permissions");
    let digest = studio.run("ball.rhai", &json!([])).event("scene")["digest"].clone();
    let saved = studio.save(&digest, &json!([["mu_l", 0.75]]));
    assert_eq!(saved.status, 200, "{}", saved.text());
    assert!(fs::symlink_metadata(&link).expect("a link").is_symlink() && mode(&real) == 0o640);
    assert_eq!(studio.read("scenarios/lib/real.rhai"), "mu_l(0.75);\nmobile(\"a\").rect(1, 1);\n");
    fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).expect("permissions");
    let refused = studio.save(&saved.json()["digest"], &json!([["mu_l", 0.25]]));
    assert!(refused.status == 500 && refused.text().contains("read-only"), "{}", refused.text());
}

#[test]
fn the_end_that_the_snapshot_expects_lies_over_the_one_that_came_out() {
    let studio = Studio::open(&[], &[env!("CARGO_MANIFEST_DIR")]);
    let name = "scenarios/vehicles/pileup_12.rhai";
    let told = studio.run(name, &json!([]));
    let ghosts = &told.event("scene")["expected"]["bodies"];
    assert_eq!((ghosts.as_array().map(Vec::len), &ghosts[2]["name"]), (Some(14), &json!("car0")));
    let difference = &told.event("done")["difference"];
    assert_eq!((&difference["moved"], &difference["missing"]), (&json!(0), &json!(0)));
    let other = studio.run(name, &json!([["speed", 20]]));
    let difference = &other.event("done")["difference"];
    assert!(difference["moved"].as_u64() >= Some(10) && difference["distance"].as_f64() > Some(0.1), "{difference}");
}

#[cfg(unix)]
#[test]
fn an_interruption_ends_it_whatever_is_going_on() {
    let files = [("scenarios/endless.rhai", "loop { }")];
    let mut studio = Studio::open(&files, &["--script-timeout", "1000", "--run-timeout", "1000"]);
    let mut page = studio.connect();
    let question = json!({ "scenario": "endless.rhai", "set": [] }).to_string();
    let line = format!("POST {} HTTP/1.1", studio.path("run"));
    let asked = request(&line, &[&studio.host(), "Content-Type: application/json"], &question);
    page.write_all(asked.as_bytes()).expect("it can be asked");
    assert_eq!(studio.get("scenarios").status, 200);
    let pid = rustix::process::Pid::from_child(&studio.process);
    rustix::process::kill_process(pid, rustix::process::Signal::INT).expect("it is there");
    assert_eq!(studio.process.wait().expect("it ends").code(), Some(0));
}

#[test]
fn a_port_that_is_taken_is_told_of() {
    let studio = Studio::with_ball();
    let port = studio.port.to_string();
    let second =
        choque().current_dir(studio.folder.path()).args(["studio", "--port", &port]).output().expect("it ends");
    let text = String::from_utf8_lossy(&second.stderr).into_owned();
    assert!(second.status.code() == Some(2) && text.contains("without --port") && second.stdout.is_empty(), "{text}");
}
