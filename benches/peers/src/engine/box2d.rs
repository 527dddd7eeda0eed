//! Box2D 3.2 through its C interface. A pair's friction is the geometric mean of its shapes', its restitution the greater of the two: its own
//! defaults. Its memory comes from this program's allocator, so that it is counted with all the rest.

#![expect(unsafe_code, reason = "Box2D is written in C")]

use std::alloc::{Layout, alloc, dealloc};
use std::ffi::{c_char, c_int, c_void};
use std::mem::MaybeUninit;
use std::sync::Once;

use boxdd_sys::ffi;

use super::{How, Motion};
use crate::scene::{self, Role, Scene};

/// Faster than anything here, for scenes that ask for exact answers \[m/s\].
const NO_CAP: f32 = 1e9;

/// A world of Box2D's.
pub(super) struct World {
    id: ffi::b2WorldId,
    bodies: Vec<ffi::b2BodyId>,
    time_step: f32,
    substeps: c_int,
}

impl World {
    pub(super) fn new(scene: &Scene, how: &How) -> World {
        set_up();
        // SAFETY: fills in a plain struct; called from one thread, as everything here.
        let mut def = unsafe { ffi::b2DefaultWorldDef() };
        def.gravity = vec2(scene.gravity);
        def.enableSleep = scene.sleeping;
        def.workerCount = c_int::try_from(how.threads).unwrap_or(1);
        if how.exact {
            def.restitutionThreshold = 0.0;
            def.maximumLinearSpeed = NO_CAP;
        }
        // SAFETY: `def` came from `b2DefaultWorldDef` and lives through the call.
        let id = unsafe { ffi::b2CreateWorld(&def) };
        let bodies = scene.bodies.iter().map(|body| create(id, body, scene.drag, how.exact)).collect();
        World { id, bodies, time_step: how.time_step as f32, substeps: c_int::try_from(how.substeps).unwrap_or(4) }
    }
}

impl Drop for World {
    fn drop(&mut self) {
        // SAFETY: the world was created by `new` and is destroyed once; no identifier of it outlives `self`.
        unsafe { ffi::b2DestroyWorld(self.id) }
    }
}

impl super::World for World {
    fn step(&mut self) {
        // SAFETY: the world lives as long as `self`, and no other step of it is under way: `self` is borrowed for this one.
        unsafe { ffi::b2World_Step(self.id, self.time_step, self.substeps) }
    }

    fn bodies(&self) -> usize {
        // SAFETY: the world lives as long as `self`; the call only reads.
        let counters = unsafe { ffi::b2World_GetCounters(self.id) };
        usize::try_from(counters.bodyCount).unwrap_or(0)
    }

    fn motion(&self, body: usize) -> Motion {
        let id = self.bodies[body];
        // SAFETY: the body lives as long as its world, which is `self`'s; these calls only read.
        let (at, turn, v, spin) = unsafe {
            (
                ffi::b2Body_GetPosition(id),
                ffi::b2Body_GetRotation(id),
                ffi::b2Body_GetLinearVelocity(id),
                ffi::b2Body_GetAngularVelocity(id),
            )
        };
        Motion {
            at: [f64::from(at.x), f64::from(at.y)],
            angle: libm::atan2(f64::from(turn.s), f64::from(turn.c)),
            velocity: [f64::from(v.x), f64::from(v.y)],
            spin: f64::from(spin),
        }
    }

    fn contacts(&self) -> Option<usize> {
        Some(self.bodies.iter().map(|body| touching_as_first(*body)).sum())
    }
}

/// Contacts of a body that touch and name a shape of its first: over all bodies each counts once.
fn touching_as_first(body: ffi::b2BodyId) -> usize {
    // SAFETY: the caller's world keeps the body alive; the call only reads.
    let capacity = unsafe { ffi::b2Body_GetContactCapacity(body) };
    let mut contacts: Vec<MaybeUninit<ffi::b2ContactData>> = Vec::new();
    contacts.resize_with(usize::try_from(capacity).unwrap_or(0), MaybeUninit::uninit);
    // SAFETY: there is room for `capacity` entries, of which the call writes the first it says.
    let written = unsafe { ffi::b2Body_GetContactData(body, contacts.as_mut_ptr().cast(), capacity) };
    let is_first = |contact: &MaybeUninit<ffi::b2ContactData>| {
        // SAFETY: one of the entries written, whose shape lives as long as the world.
        let owner = unsafe { ffi::b2Shape_GetBody(contact.assume_init_ref().shapeIdA) };
        owner.index1 == body.index1
    };
    contacts[..usize::try_from(written).unwrap_or(0)].iter().filter(|contact| is_first(contact)).count()
}

fn create(world: ffi::b2WorldId, body: &scene::Body, drag: f64, exact: bool) -> ffi::b2BodyId {
    let (sin, cos) = libm::sincos(body.angle);
    // SAFETY: fills in a plain struct.
    let mut def = unsafe { ffi::b2DefaultBodyDef() };
    def.type_ = match body.role {
        Role::Fixed => ffi::b2BodyType_b2_staticBody,
        Role::Driven => ffi::b2BodyType_b2_kinematicBody,
        Role::Mobile => ffi::b2BodyType_b2_dynamicBody,
    };
    def.position = vec2(body.at);
    def.rotation = ffi::b2Rot { c: cos as f32, s: sin as f32 };
    def.linearVelocity = vec2(body.velocity);
    def.angularVelocity = body.spin as f32;
    def.linearDamping = drag as f32;
    def.isAwake = !body.asleep;
    def.isBullet = body.bullet;
    def.allowFastRotation = exact;
    // SAFETY: `def` came from `b2DefaultBodyDef` and lives through the call; the world has just been created.
    let id = unsafe { ffi::b2CreateBody(world, &def) };
    add_shapes(id, body);
    if body.locked {
        // SAFETY: the body lives. Moment of inertia 0 stands for an infinite one; a lock alone would leave it finite in impacts.
        unsafe {
            let mut mass = ffi::b2Body_GetMassData(id);
            mass.rotationalInertia = 0.0;
            ffi::b2Body_SetMassData(id, mass);
        }
    }
    id
}

fn add_shapes(id: ffi::b2BodyId, body: &scene::Body) {
    // SAFETY: fills in a plain struct.
    let mut def = unsafe { ffi::b2DefaultShapeDef() };
    def.density = body.density as f32;
    def.material.friction = body.friction as f32;
    def.material.restitution = body.restitution as f32;
    let upright = ffi::b2Rot { c: 1.0, s: 0.0 };
    for rect in &body.rects {
        let [x, y] = rect.half.map(|half| half as f32);
        // SAFETY: sizes are finite and positive, `def` came from `b2DefaultShapeDef`, the body lives, and the polygon is copied.
        unsafe {
            let polygon = ffi::b2MakeOffsetBox(x, y, vec2(rect.at), upright);
            ffi::b2CreatePolygonShape(id, &def, &polygon);
        }
    }
}

fn vec2([x, y]: [f64; 2]) -> ffi::b2Vec2 {
    ffi::b2Vec2 { x: x as f32, y: y as f32 }
}

/// What Box2D aligns everything to, and of what its sizes are multiples.
const ALIGNMENT: usize = 32;

/// Makes Box2D take its memory from this program's allocator, and keeps its messages out of what this program prints.
fn set_up() {
    static ONCE: Once = Once::new();
    // SAFETY: before the first world is created Box2D holds no memory that another allocator gave; the functions keep to the
    // contracts of those they replace.
    ONCE.call_once(|| unsafe {
        ffi::b2SetAllocator(Some(give), Some(take));
        ffi::b2SetLogFcn(Some(ignore));
    });
}

/// It says when a buffer is too small and another is used; that costs time, which is measured.
unsafe extern "C" fn ignore(_: *const c_char) {}

fn layout(size: usize, alignment: usize) -> Option<Layout> {
    Layout::from_size_align(size.next_multiple_of(ALIGNMENT), alignment).ok().filter(|layout| layout.size() > 0)
}

unsafe extern "C" fn give(size: usize, alignment: c_int) -> *mut c_void {
    let layout = usize::try_from(alignment).ok().and_then(|alignment| layout(size, alignment));
    // SAFETY: the layout's size is not 0.
    layout.map_or(std::ptr::null_mut(), |layout| unsafe { alloc(layout).cast() })
}

unsafe extern "C" fn take(memory: *mut c_void, size: usize) {
    if let Some(layout) = layout(size, ALIGNMENT) {
        // SAFETY: Box2D gives back what `give` gave, asks for its alignment only, and rounds sizes up as `layout` does.
        unsafe { dealloc(memory.cast(), layout) }
    }
}
