//! Every pair, as §2.3 writes it: the executable specification of what is tested.

use crate::bodies::Bodies;
use crate::work::Work;

/// Shows every pair i < j of collidable bodies, one of them mobile, in order.
pub fn visit(bodies: &Bodies, work: &mut Work, mut visit: impl FnMut(usize, usize, &mut Work)) {
    for i in 0..bodies.len() {
        if bodies.rects_of(i).is_empty() {
            continue;
        }
        for j in i + 1..bodies.len() {
            if !bodies.rects_of(j).is_empty() && super::can_collide(bodies, i, j) {
                visit(i, j, work);
            }
        }
    }
}
