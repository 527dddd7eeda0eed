//! Who may ask the studio anything: this machine's own pages, and those only.
//!
//! The address holds a random token, so that nobody guesses it. What a browser says of where a request comes from is checked
//! all the same: a name that was made to lead here (DNS rebinding) is not the host that was printed, and another site's page
//! is another origin.

use std::fmt::Write as _;
use std::io;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// What every answer says to the browser: nothing but our own files, in no frame, remembered nowhere.
const HEADERS: [(HeaderName, &str); 6] = [
    (
        header::CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; \
         base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::CACHE_CONTROL, "no-store"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
];

/// The address of the studio, and what follows from it.
#[derive(Clone, Debug)]
pub(super) struct Guard {
    hosts: Arc<[String]>,
    token: Arc<str>,
}

impl Guard {
    /// With a new token, for a port.
    pub(super) fn new(port: u16) -> io::Result<Self> {
        let mut bytes = [0_u8; 16];
        getrandom::fill(&mut bytes).map_err(io::Error::from)?;
        let mut token = String::new();
        for byte in bytes {
            let _ = write!(token, "{byte:02x}"); // a string takes everything
        }
        let names = ["127.0.0.1", "localhost"];
        let mut hosts: Vec<String> = names.iter().map(|name| format!("{name}:{port}")).collect();
        if port == 80 {
            hosts.extend(names.map(str::to_owned)); // browsers leave this port out
        }
        Ok(Guard { hosts: hosts.into(), token: token.into() })
    }

    /// What is printed, and opened in a browser.
    pub(super) fn address(&self) -> String {
        format!("http://{}{}", self.hosts[0], self.path(""))
    }

    /// The path of one of the studio's own resources.
    pub(super) fn path(&self, name: &str) -> String {
        format!("/{}/{name}", self.token)
    }

    /// Why a request is not answered, if it is not.
    fn objection(&self, authority: Option<&str>, headers: &HeaderMap) -> Option<&'static str> {
        let mut hosts = headers.get_all(header::HOST).iter();
        let host = match (hosts.next().map(HeaderValue::to_str), hosts.next()) {
            (Some(Ok(host)), None) => host,
            _ => return Some("a request must name one host"),
        };
        let is_ours = |host: &str| self.hosts.iter().any(|ours| ours == host);
        if !is_ours(host) || authority.is_some_and(|authority| authority != host) {
            return Some("the studio answers at the address it printed, and at no other name");
        }
        let is_same = |origin: &HeaderValue| origin.as_bytes() == format!("http://{host}").as_bytes();
        if !headers.get_all(header::ORIGIN).iter().all(is_same) {
            return Some("the studio answers its own page, and no other site's");
        }
        let own = |site: &HeaderValue| site == "same-origin" || site == "none";
        if !headers.get_all("sec-fetch-site").iter().all(own) {
            return Some(
                "the studio answers its own page, and no other site's: paste its address instead of following a link",
            );
        }
        None
    }
}

/// Answers what is refused, and adds what every answer says.
pub(super) async fn check(State(guard): State<Guard>, request: Request, next: Next) -> Response {
    let authority = request.uri().authority().map(|authority| authority.as_str());
    let mut response = match guard.objection(authority, request.headers()) {
        Some(why) => (StatusCode::FORBIDDEN, format!("{why}\n")).into_response(),
        None => next.run(request).await,
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

/// What is answered where nothing is: also without the token, or with a wrong one.
pub(super) async fn nothing_here() -> Response {
    let why =
        "there is nothing here: open the whole address that `choque studio` printed, its long last part included\n";
    (StatusCode::NOT_FOUND, why).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn objection(headers: &[(&'static str, &str)]) -> bool {
        let guard =
            Guard { hosts: ["127.0.0.1:8000".to_owned(), "localhost:8000".to_owned()].into(), token: "t".into() };
        let named = headers.iter().map(|(name, value)| {
            (HeaderName::from_static(name), HeaderValue::from_str(value).expect("a header's value"))
        });
        let mut map = HeaderMap::new();
        for (name, value) in named {
            map.append(name, value);
        }
        guard.objection(None, &map).is_some()
    }

    #[test]
    fn only_the_printed_address_and_its_own_page_are_answered() {
        let host = ("host", "127.0.0.1:8000");
        for answered in [
            &[host][..],
            &[("host", "localhost:8000")],
            &[host, ("origin", "http://127.0.0.1:8000")],
            &[host, ("sec-fetch-site", "none")],
            &[host, ("sec-fetch-site", "same-origin")],
        ] {
            assert!(!objection(answered), "{answered:?}");
        }
        for refused in [
            &[][..],
            &[host, host],
            &[("host", "127.0.0.1")],
            &[("host", "127.0.0.1:8001")],
            &[("host", "example.org:8000")],
            &[("host", "127.0.0.1:8000.example.org")],
            &[host, ("origin", "null")],
            &[host, ("origin", "http://localhost:8000")],
            &[host, ("origin", "https://127.0.0.1:8000")],
            &[host, ("origin", "http://127.0.0.1:8000"), ("origin", "http://example.org")],
            &[host, ("sec-fetch-site", "cross-site")],
            &[host, ("sec-fetch-site", "same-site")],
        ] {
            assert!(objection(refused), "{refused:?}");
        }
    }

    #[test]
    fn every_studio_has_a_token_of_its_own() {
        let [a, b] = [0, 1].map(|_| Guard::new(8000).expect("random numbers").address());
        assert!(a != b && a.len() == "http://127.0.0.1:8000//".len() + 32, "{a} {b}");
    }
}
