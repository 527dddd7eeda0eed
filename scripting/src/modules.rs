//! `import`: modules are scripts below the script's folder or below the library.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::rc::Rc;

use rhai::{AST, Engine, EvalAltResult, GlobalRuntimeState, Module, ModuleResolver, Position, Scope, Shared};

use crate::calls;
use crate::error::{Complaint, Diagnostic};
use crate::library::{Found, Library, read_text};
use crate::sandbox;
use crate::session::{self, RhaiResultOf, complain};

/// Finds, reads and compiles modules, each once; a session runs each once, however often it is imported.
pub(crate) struct Resolver {
    library: Rc<Library>,
    compiled: RefCell<BTreeMap<PathBuf, Rc<AST>>>,
    /// The scripts being run, outermost first: one that is met again imports itself.
    running: RefCell<Vec<Found>>,
}

impl Resolver {
    /// A resolver for a script.
    pub(crate) fn new(library: Rc<Library>, script: Found) -> Self {
        Resolver { library, compiled: RefCell::default(), running: RefCell::new(vec![script]) }
    }

    fn find(&self, path: &str) -> Result<Found, Complaint> {
        let found = self.library.find("import", path, ".rhai")?;
        let running = self.running.borrow();
        if let Some(at) = running.iter().position(|script| script.canonical == found.canonical) {
            let circle: Vec<String> = running[at..].iter().map(|script| script.shown.display().to_string()).collect();
            return Err(Complaint::new(format!("import: \"{path}\" imports itself")).hint(format!(
                "the circle is {} → {}",
                circle.join(" → "),
                circle[0]
            )));
        }
        Ok(found)
    }

    fn compile(&self, engine: &Engine, found: &Found, name: &str) -> RhaiResultOf<Rc<AST>> {
        if let Some(ast) = self.compiled.borrow().get(&found.canonical) {
            return Ok(ast.clone());
        }
        let text = read_text(&found.canonical, &found.shown).map_err(as_script_error)?;
        self.library.keep(name, &text);
        let mut ast = sandbox::compile(engine, &text).map_err(|error| within(name, Box::new(error.into())))?;
        if let Some((function, complaint)) = calls::hidden_word(&text) {
            return Err(within(name, complain(complaint, function.position())));
        }
        ast.set_source(name);
        let ast = Rc::new(ast);
        self.compiled.borrow_mut().insert(found.canonical.clone(), ast.clone());
        Ok(ast)
    }

    fn run(&self, engine: &Engine, global: &mut GlobalRuntimeState, found: &Found) -> RhaiResultOf<Shared<Module>> {
        let name = found.shown.display().to_string();
        let ast = self.compile(engine, found, &name)?;
        let module = Module::eval_ast_as_new_raw(engine, &mut Scope::new(), global, &ast);
        Ok(module.map_err(|error| within(&name, error))?.into())
    }
}

impl ModuleResolver for Resolver {
    fn resolve_raw(
        &self,
        engine: &Engine,
        global: &mut GlobalRuntimeState,
        _: &mut Scope,
        path: &str,
        position: Position,
    ) -> RhaiResultOf<Shared<Module>> {
        let found = self.find(path).map_err(|complaint| complain(complaint, position))?;
        let session = session::of(&global.tag);
        let known = session.as_ref().and_then(|session| session.borrow().modules.get(&found.canonical).cloned());
        if let Some(module) = known {
            return Ok(module);
        }
        self.running.borrow_mut().push(found.clone());
        let outcome = self.run(engine, global, &found);
        self.running.borrow_mut().pop();
        let module = outcome.map_err(|mut error| {
            error.set_position(position);
            error
        })?;
        if let Some(session) = session {
            session.borrow_mut().modules.insert(found.canonical, module.clone());
        }
        Ok(module)
    }

    fn resolve(
        &self,
        engine: &Engine,
        _: Option<&str>,
        path: &str,
        position: Position,
    ) -> RhaiResultOf<Shared<Module>> {
        self.resolve_raw(engine, &mut engine.new_global_runtime_state(), &mut Scope::new(), path, position)
    }
}

fn within(module: &str, error: Box<EvalAltResult>) -> Box<EvalAltResult> {
    EvalAltResult::ErrorInModule(module.to_owned(), error, Position::NONE).into()
}

fn as_script_error(diagnostic: Diagnostic) -> Box<EvalAltResult> {
    complain(Complaint::new(diagnostic.message).maybe_hint(diagnostic.hint), Position::NONE)
}
