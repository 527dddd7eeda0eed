//! The words for what holds for the whole scene.

use choque_engine::scene::{BroadPhaseChoice, Detection, ExchangeRule, MotionRule, Settings};
use rhai::plugin::*;
use rhai::{Dynamic, ImmutableString};

use super::{Choice, Number, Text, Truth};
use crate::error::Complaint;
use crate::number;
use crate::session::{self, Phase, RhaiResultOf, Site};
use crate::suggest::did_you_mean;

/// Characters a title may have.
const LONGEST_TITLE: usize = 200;
/// Characters the name of a tunable number may have.
const LONGEST_NAME: usize = 100;

#[export_module]
pub(crate) mod module {
    /// The title of the scenario, shown in output. Default: the file's name.
    ///
    /// ```rhai
    /// title("Spinning blade");
    /// ```
    #[rhai_fn(return_raw)]
    pub fn title(context: NativeCallContext, text: Text) -> RhaiResultOf<()> {
        session::build(&context, |draft| {
            draft.scene.title = number::label("title", &text, LONGEST_TITLE)?.into();
            Ok(())
        })
    }

    /// The length of one iteration \[s\], greater than 0. Default: 1/60.
    ///
    /// ```rhai
    /// time_step(1/120);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn time_step(context: NativeCallContext, seconds: Number) -> RhaiResultOf<()> {
        let seconds = number::positive("time_step", &seconds);
        set(&context, seconds, |settings, seconds| settings.time_step = seconds)
    }

    /// How many iterations a run makes, 0 or more. Default: 600.
    ///
    /// ```rhai
    /// steps(240);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn steps(context: NativeCallContext, count: Number) -> RhaiResultOf<()> {
        let count = number::count("steps", &count);
        set(&context, count, |settings, count| settings.steps = count)
    }

    /// μ_L of the document's exchange: the share of linear momentum that is handed over, 0 or more. Default: 1.
    /// `--set mu_l=…` wins over it.
    ///
    /// ```rhai
    /// mu_l(0.9);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn mu_l(context: NativeCallContext, share: Number) -> RhaiResultOf<()> {
        let share = number::not_negative("mu_l", &share);
        set(&context, share, |settings, share| settings.mu_l = share)
    }

    /// μ_A of the document's exchange: the share of angular momentum that is handed over, 0 or more. Default: 1.
    /// `--set mu_a=…` wins over it.
    ///
    /// ```rhai
    /// mu_a(0.8);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn mu_a(context: NativeCallContext, share: Number) -> RhaiResultOf<()> {
        let share = number::not_negative("mu_a", &share);
        set(&context, share, |settings, share| settings.mu_a = share)
    }

    /// ε of the document's relocation: the gap it leaves \[m\], 0 or more. Default: 0.001.
    /// `--set epsilon=…` wins over it. The impulse exchange does not relocate.
    ///
    /// ```rhai
    /// epsilon(0.005);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn epsilon(context: NativeCallContext, gap: Number) -> RhaiResultOf<()> {
        let gap = number::not_negative("epsilon", &gap);
        set(&context, gap, |settings, gap| settings.epsilon = gap)
    }

    /// The height Y of the collision plane \[m\]. Default: 0. A body whose meshes do not cross it moves, but
    /// collides with nothing.
    ///
    /// ```rhai
    /// plane(0.5);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn plane(context: NativeCallContext, height: Number) -> RhaiResultOf<()> {
        let height = number::finite("plane", &height);
        set(&context, height, |settings, height| settings.plane = height)
    }

    /// How motion is handed over at a collision: `"document"`, the document's rules (the default), or
    /// `"impulse"`, Newton–Euler impulses with restitution and friction.
    ///
    /// ```rhai
    /// exchange("impulse");
    /// ```
    #[rhai_fn(return_raw)]
    pub fn exchange(context: NativeCallContext, rule: Choice) -> RhaiResultOf<()> {
        let rule = choose("exchange", &rule, ExchangeRule::WORDS, ExchangeRule::from_word);
        set(&context, rule, |settings, rule| settings.exchange = rule)
    }

    /// How overlaps are found: `"vertices"`, a vertex of one inside the other (the default of the document's
    /// exchange), or `"complete"`, every overlap (the default of the impulse exchange).
    ///
    /// ```rhai
    /// detection("complete");
    /// ```
    #[rhai_fn(return_raw)]
    pub fn detection(context: NativeCallContext, way: Choice) -> RhaiResultOf<()> {
        let way = choose("detection", &way, Detection::WORDS, Detection::from_word);
        set(&context, way, |settings, way| settings.detection = Some(way))
    }

    /// When collisions are treated: `"stepped"`, after each step (the default), or `"continuous"`, at the moment
    /// of impact, so that nothing passes through anything.
    ///
    /// ```rhai
    /// motion("continuous");
    /// ```
    #[rhai_fn(return_raw)]
    pub fn motion(context: NativeCallContext, rule: Choice) -> RhaiResultOf<()> {
        let rule = choose("motion", &rule, MotionRule::WORDS, MotionRule::from_word);
        set(&context, rule, |settings, rule| settings.motion = rule)
    }

    /// In how many equal parts an iteration solves contacts, 1 to 1000, with `exchange("impulse")` and
    /// `motion("stepped")`: more hold high piles and great ratios of masses better, and take longer. Default: 4.
    ///
    /// ```rhai
    /// substeps(8);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn substeps(context: NativeCallContext, count: Number) -> RhaiResultOf<()> {
        let count = number::substeps("substeps", &count);
        set(&context, count, |settings, count| settings.substeps = Some(count))
    }

    /// Whether a scene in which all has come to rest sleeps until a command wakes it, with `exchange("impulse")` and
    /// `motion("stepped")`: asleep it takes no time, and nothing ends up elsewhere for it. Default: false.
    ///
    /// ```rhai
    /// sleeping(true);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn sleeping(context: NativeCallContext, allowed: Truth) -> RhaiResultOf<()> {
        let allowed = number::truth("sleeping", &allowed);
        set(&context, allowed, |settings, allowed| settings.sleeping = allowed)
    }

    /// How the pairs worth testing are found: `"auto"` (the default), `"all_pairs"` or `"strips"`. The result is
    /// the same; only the time it takes is not.
    ///
    /// ```rhai
    /// broad_phase("strips");
    /// ```
    #[rhai_fn(return_raw)]
    pub fn broad_phase(context: NativeCallContext, way: Choice) -> RhaiResultOf<()> {
        let way = choose("broad_phase", &way, BroadPhaseChoice::WORDS, BroadPhaseChoice::from_word);
        set(&context, way, |settings, way| settings.broad_phase = way)
    }

    /// The coefficient of restitution of the impulse exchange, 0 (nothing bounces) to 1 (all of it). Default: 0.
    /// A body may have its own. `--set restitution=…` wins over it.
    ///
    /// ```rhai
    /// exchange("impulse");
    /// restitution(0.5);
    /// ```
    #[rhai_fn(name = "restitution", return_raw)]
    pub fn scene_restitution(context: NativeCallContext, e: Number) -> RhaiResultOf<()> {
        let e = number::unit_range("restitution", &e);
        set(&context, e, |settings, e| settings.restitution = e)
    }

    /// The coefficient of friction of the impulse exchange, 0 or more. Default: 0. A body may have its own.
    /// `--set friction=…` wins over it.
    ///
    /// ```rhai
    /// exchange("impulse");
    /// friction(0.6);
    /// ```
    #[rhai_fn(name = "friction", return_raw)]
    pub fn scene_friction(context: NativeCallContext, mu: Number) -> RhaiResultOf<()> {
        let mu = number::not_negative("friction", &mu);
        set(&context, mu, |settings, mu| settings.friction = mu)
    }

    /// The acceleration of every mobile body \[m/s²\]. Default: none.
    ///
    /// ```rhai
    /// gravity(0, -9.81);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn gravity(context: NativeCallContext, x: Number, z: Number) -> RhaiResultOf<()> {
        let acceleration = number::pair(number::finite, ("gravity: x", &x), ("gravity: z", &z));
        set(&context, acceleration, |settings, acceleration| settings.gravity = acceleration)
    }

    /// How fast the velocity and the spin of mobile bodies decay \[1/s\], 0 or more, as an exact exponential.
    /// Default: not at all.
    ///
    /// ```rhai
    /// drag(0.4, 1);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn drag(context: NativeCallContext, linear: Number, angular: Number) -> RhaiResultOf<()> {
        let rates = number::pair(number::not_negative, ("drag: linear", &linear), ("drag: angular", &angular));
        set(&context, rates, |settings, rates| settings.drag = rates)
    }

    /// A tunable number: `default`, unless `--set NAME=VALUE` says otherwise. May be asked for again anywhere.
    ///
    /// ```rhai
    /// let push = param("push", 8);
    /// ```
    #[rhai_fn(return_raw)]
    pub fn param(context: NativeCallContext, name: Text, default: Number) -> RhaiResultOf<Number> {
        declare(&context, &name, &default, None)
    }

    /// A tunable number with the least and the greatest value worth trying; others are refused.
    ///
    /// ```rhai
    /// let push = param("push", 8, 0, 30);
    /// ```
    #[rhai_fn(name = "param", return_raw)]
    pub fn param_in_range(
        context: NativeCallContext,
        name: Text,
        default: Number,
        min: Number,
        max: Number,
    ) -> RhaiResultOf<Number> {
        declare(&context, &name, &default, Some((&min, &max)))
    }
}

fn set<T>(
    context: &NativeCallContext,
    value: Result<T, Complaint>,
    write: impl FnOnce(&mut Settings, T),
) -> RhaiResultOf<()> {
    session::build(context, |draft| {
        write(&mut draft.scene.settings, value?);
        Ok(())
    })
}

fn choose<T>(
    setting: &str,
    choice: &Dynamic,
    words: &[&str],
    from_word: fn(&str) -> Option<T>,
) -> Result<T, Complaint> {
    let word = number::text(setting, choice)?;
    let quote = |word: &str| format!("{setting}(\"{word}\")");
    from_word(&word).ok_or_else(|| {
        let all = words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(" or ");
        Complaint::new(format!("{setting} must be {all}, not \"{word}\"")).maybe_hint(did_you_mean(
            &word,
            words.iter().copied(),
            quote,
        ))
    })
}

fn declare(
    context: &NativeCallContext,
    name: &Dynamic,
    default: &Dynamic,
    range: Option<(&Dynamic, &Dynamic)>,
) -> RhaiResultOf<Dynamic> {
    let site = Site::of(context);
    session::with(context, |session| {
        let name: ImmutableString = number::label("param: name", name, LONGEST_NAME)?;
        let bound = |which, value| number::finite(&format!("param \"{name}\": {which}"), value);
        let range = match range {
            Some((min, max)) => Some((bound("min", min)?, bound("max", max)?)),
            None => None,
        };
        match session.phase {
            Phase::Building(_) => session.params.declare(&name, default, range, site),
            Phase::Running(_) => session.params.recall(&name, default, range, &site),
        }
    })
}
