//! What may be tuned of a scenario from outside, with the value that it has and the one that its script gives.

use choque_engine::scene::Settings;

use crate::params::SETTINGS;

/// A number that `--set` reaches.
#[derive(Clone, Debug, PartialEq)]
pub struct Control {
    /// Its name in `--set NAME=VALUE`.
    pub name: String,
    /// Declared by the script with `param`; otherwise one of the settings `mu_l`, `mu_a`, `epsilon`, `restitution`,
    /// `friction`.
    pub is_param: bool,
    /// The value used.
    pub value: f64,
    /// The value without any `--set`: what the script gives it, or else the default.
    pub written: f64,
    /// Least and greatest value, where the script gives them; others are refused.
    pub range: Option<(f64, f64)>,
    /// Whether the script writes it, and its bounds, as whole numbers: it may be a count.
    pub is_whole: bool,
}

/// The settings that may be tuned, from what a script gives and what is used.
pub(crate) fn of_settings(written: &Settings, used: &Settings) -> impl Iterator<Item = Control> {
    let values = |settings: &Settings| {
        let Settings { mu_l, mu_a, epsilon, restitution, friction, .. } = settings;
        [*mu_l, *mu_a, *epsilon, *restitution, *friction]
    };
    let both = values(written).into_iter().zip(values(used));
    SETTINGS.into_iter().zip(both).map(|(name, (written, value))| Control {
        name: name.to_owned(),
        is_param: false,
        value,
        written,
        range: None,
        is_whole: false,
    })
}
