//! P12, P12b: what each contact of a column at rest carries.

use choque_engine::{BodyId, Load, World};

use super::kit::{DT, G, block, floor, grounded, resting, watch};

/// How far a load may be off, as a share of m g. Observed: not yet.
const LOAD_OFF: f64 = 1e-6;

/// The load between two bodies, each push with the x of its point, from left to right.
fn pushes(world: &World, a: &str, b: &str) -> Vec<(f64, f64)> {
    let find = |name: &str| world.find(name).expect("it is there");
    let (a, b): (BodyId, BodyId) = (find(a), find(b));
    let load: Load = world.loads().into_iter().find(|load| load.a == a && load.b == b).expect("they touch");
    assert!((load.normal.y - 1.0).abs() <= 1e-9, "it points up, from a to b: {:?}", load.normal);
    let mut pushes: Vec<(f64, f64)> = load.points.iter().zip(load.push).map(|(point, push)| (point.x, push)).collect();
    pushes.sort_by(|p, q| p.0.total_cmp(&q.0));
    pushes
}

#[track_caller]
fn assert_push(found: f64, weights: f64, what: &str) {
    println!("{what}: {:.9} m g instead of {weights}", found / G);
    assert!((found / G - weights).abs() <= LOAD_OFF, "{what}: {} m g instead of {weights}", found / G);
}

/// Twelve boxes, 1 cm left and right of the middle in turn. Interfaces are 0.98 wide; the weight above stands where the mean of its boxes
/// is, so that under the lowest box 5.88 and 6.12 m g fall to left and right, and 0.4898 and 0.5102 m g under the top one.
#[test]
fn p12_each_box_carries_what_is_above_it() {
    let boxes = (0..12).map(|k| {
        let x = if k % 2 == 0 { -0.01 } else { 0.01 };
        resting(&format!("box{k}"), (1.0, 1.0), (x, 0.5 + f64::from(k)))
    });
    let world = watch(&grounded(DT, 0.3, std::iter::once(floor()).chain(boxes).collect()), 600, |_| {});
    for k in 0..12 {
        let below = if k == 0 { "floor".to_owned() } else { format!("box{}", k - 1) };
        let found = pushes(&world, &below, &format!("box{k}"));
        assert_push(found.iter().map(|(_, push)| push).sum(), f64::from(12 - k), &format!("under box {k}"));
    }
    let lowest = pushes(&world, "floor", "box0");
    assert_push(lowest[0].1, 5.88, "left under box 0");
    assert_push(lowest[1].1, 6.12, "right under box 0");
    let highest = pushes(&world, "box10", "box11");
    assert_push(highest[0].1, 0.48979592, "left under box 11");
    assert_push(highest[1].1, 0.51020408, "right under box 11");
}

/// 400 kg on two boxes of 1 kg: each carries 200 m g and stands on the floor with 201.
#[test]
fn p12b_two_small_boxes_carry_a_great_one() {
    let small = [("left", -9.0), ("right", 9.0)].map(|(name, x)| resting(name, (1.0, 1.0), (x, 0.5)));
    let heavy = block("heavy", (20.0, 20.0), (0.0, 11.0), (0.0, 0.0), 400.0);
    let bodies = std::iter::once(floor()).chain(small).chain([heavy]).collect();
    let world = watch(&grounded(DT, 0.6, bodies), 600, |_| {});
    for name in ["left", "right"] {
        let on_top: f64 = pushes(&world, name, "heavy").iter().map(|(_, push)| push).sum();
        assert_push(on_top / 200.0, 1.0, &format!("on {name}, in 200 m g"));
        let below: f64 = pushes(&world, "floor", name).iter().map(|(_, push)| push).sum();
        assert_push(below / 201.0, 1.0, &format!("under {name}, in 201 m g"));
    }
}
