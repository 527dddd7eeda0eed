//! Relocation (§2.4): one body moves by the least distance plus ε, so that the pair does not stick.

use crate::area::Vec2;
use crate::bodies::Bodies;
use crate::detect::Contact;

/// A contact after relocation: the two arms from the bodies' centres to the point of collision (figure 13).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The body whose vertex it is.
    pub owner: usize,
    /// The body it lay in.
    pub reference: usize,
    /// `R(θ_owner)·vertex`: from the owner's centre, in world directions \[m\].
    pub r_owner: Vec2,
    /// `R(θ_ref)·(the vertex put onto the face)`: from the reference's centre \[m\].
    pub r_reference: Vec2,
    /// Outward normal of the face, in world directions.
    pub normal: Vec2,
    /// The point of collision, ε left out (R6): on the body that stayed \[m\].
    pub point: Vec2,
}

/// The body of a contact that is moved: the reference if it is mobile, else the vertex's owner.
#[must_use]
pub fn moved(bodies: &Bodies, contact: &Contact) -> usize {
    if bodies.is_mobile(contact.reference) { contact.reference } else { contact.owner }
}

/// Moves the reference if it is mobile, else the vertex's owner, by (depth + ε) along the face's normal.
pub fn separate(bodies: &mut Bodies, contact: &Contact, epsilon: f64) -> Placed {
    let Contact { owner, reference, vertex, on_face, face, depth } = *contact;
    let normal = bodies.frame[reference].outward(face.normal());
    let r_owner = bodies.frame[owner].outward(vertex);
    let r_reference = bodies.frame[reference].outward(on_face);
    let point = if bodies.is_mobile(reference) {
        bodies.shift(reference, -normal * (depth + epsilon));
        bodies.frame[owner].o + r_owner
    } else {
        bodies.shift(owner, normal * (depth + epsilon));
        bodies.frame[reference].o + r_reference
    };
    Placed { owner, reference, r_owner, r_reference, normal, point }
}
