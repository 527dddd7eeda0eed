//! Rapier, in single and in double precision. Its own defaults are the mean of both coefficients; here each collider asks for what the others do:
//! the geometric mean of a pair's friction, the greater restitution.

/// The same code for a crate and its number.
macro_rules! world {
    ($(#[$meta:meta])* $module:ident, $rapier:ident, $real:ty) => {
        $(#[$meta])*
        pub(super) mod $module {
            use $rapier::prelude::*;

            use crate::engine::{How, Motion};
            use crate::scene::{self, Role, Scene};

            /// Faster than anything here, for scenes that ask for exact answers \[m/s\].
            const NO_CAP: $real = 1e9;

            /// A world of Rapier's.
            pub(in crate::engine) struct World {
                world: PhysicsWorld,
                bodies: Vec<RigidBodyHandle>,
            }

            impl World {
                pub(in crate::engine) fn new(scene: &Scene, how: &How) -> World {
                    let mut world = PhysicsWorld::default();
                    world.gravity = vector(scene.gravity);
                    world.integration_parameters.dt = how.time_step as $real;
                    world.integration_parameters.num_solver_iterations = how.substeps as usize;
                    if how.exact {
                        world.integration_parameters.normalized_max_linear_velocity = NO_CAP;
                    }
                    let bodies = scene.bodies.iter().map(|body| insert(&mut world, body, scene, how)).collect();
                    World { world, bodies }
                }
            }

            impl crate::engine::World for World {
                fn step(&mut self) {
                    self.world.step();
                }

                fn bodies(&self) -> usize {
                    self.world.bodies.len()
                }

                fn motion(&self, body: usize) -> Motion {
                    let body = &self.world.bodies[self.bodies[body]];
                    let (at, v) = (body.translation(), body.linvel());
                    Motion {
                        at: [at.x.into(), at.y.into()],
                        angle: body.rotation().angle().into(),
                        velocity: [v.x.into(), v.y.into()],
                        spin: body.angvel().into(),
                    }
                }

                fn contacts(&self) -> Option<usize> {
                    Some(self.world.contact_pairs().filter(|pair| pair.has_any_active_contact()).count())
                }
            }

            fn insert(world: &mut PhysicsWorld, body: &scene::Body, scene: &Scene, how: &How) -> RigidBodyHandle {
                let builder = match body.role {
                    Role::Fixed => RigidBodyBuilder::fixed(),
                    Role::Driven => RigidBodyBuilder::kinematic_velocity_based(),
                    Role::Mobile => RigidBodyBuilder::dynamic(),
                };
                let mut builder = builder
                    .translation(vector(body.at))
                    .rotation(body.angle as $real)
                    .linvel(vector(body.velocity))
                    .angvel(body.spin as $real)
                    .linear_damping(scene.drag as $real)
                    .can_sleep(scene.sleeping)
                    .sleeping(body.asleep)
                    .ccd_enabled(body.bullet)
                    .allow_fast_rotation(how.exact);
                if body.locked {
                    builder = builder.lock_rotations();
                }
                let handle = world.insert_body(builder);
                for rect in &body.rects {
                    let collider = ColliderBuilder::cuboid(rect.half[0] as $real, rect.half[1] as $real)
                        .translation(vector(rect.at))
                        .density(body.density as $real)
                        .friction(body.friction as $real)
                        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
                        .restitution(body.restitution as $real)
                        .restitution_combine_rule(CoefficientCombineRule::Max);
                    world.insert_collider(collider, Some(handle));
                }
                handle
            }

            fn vector([x, y]: [f64; 2]) -> Vector {
                Vector::new(x as $real, y as $real)
            }
        }
    };
}

world!(
    /// Single precision.
    single,
    rapier2d,
    f32
);
world!(
    /// Double precision.
    double,
    rapier2d_f64,
    f64
);
