//! The section about shadows, and what stands over their picture.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::super::*;
use super::{Desk, baked, click, desk};
use crate::base::ids::InstanceId;
use crate::render::ShadowTechnique;
use crate::render::shadow::DebugView;
use crate::viewer::action::Action;
use crate::viewer::settings::comparison::ComparisonLayout;
use crate::viewer::settings::tool::Tool;

fn live(facts: Facts<'static>) -> Harness<'static, Desk> {
    let mut desk = desk(facts);
    desk.state_mut().panels.light.is_real_time = true;
    desk.run_steps(3);
    desk
}

/// Chooses `entry` of the list that is called `list`.
fn choose(desk: &mut Harness<'static, Desk>, list: &str, entry: &str) {
    click(desk, list);
    // The list itself may show the same words.
    desk.get_all_by_label(entry).last().expect("an entry").click();
    desk.run_steps(3);
}

#[test]
fn shadows_are_compared_and_looked_into() {
    let mut desk = live(Facts { shadows: ShadowFacts { num_light_samples: 7, ..ShadowFacts::default() }, ..baked() });
    choose(&mut desk, "Compare with", "Ray-traced");
    let compared = desk.state().panels.light.compared_shadows().expect("compared shadows");
    assert_eq!(compared.settings.technique, ShadowTechnique::Raytraced);
    click(&mut desk, "Difference");
    assert_eq!(desk.state().panels.light.comparison_layout, ComparisonLayout::Difference);
    choose(&mut desk, "Look into", "Stencil counts");
    let debug = desk.state().panels.light.render_settings(true).shadow_debug.expect("a debug view");
    assert_eq!((debug.view, debug.light), (DebugView::StencilCounts, 0));
    assert!(desk.query_by_label("Light that is shown").is_some() && desk.query_by_label("of 7").is_some());
    for name in ["points a lamp", "radius of lamps"] {
        assert!(desk.query_all_by_label(name).next().is_some(), "{name}");
    }
}

#[test]
fn the_divider_of_a_split_screen_is_dragged() {
    let mut desk = live(baked());
    desk.state_mut().panels.light.compared_technique = Some(ShadowTechnique::Map);
    desk.run_steps(3);
    let free = desk.state().free;
    let at = |x: f32| egui::pos2(x, free.center().y);
    assert!(desk.query_by_label("Divider").is_some());
    desk.drag_at(at(free.center().x));
    desk.run_steps(1);
    desk.hover_at(at(free.left() + 0.25 * free.width()));
    desk.run_steps(1);
    desk.drop_at(at(free.left() + 0.25 * free.width()));
    desk.run_steps(2);
    let divider = desk.state().panels.light.divider;
    assert!((divider - 0.25).abs() < 0.02, "{divider}");
}

#[test]
fn planes_and_casters_are_chosen_by_clicking() {
    let mut desk = live(baked());
    desk.state_mut().panels.light.shadows.technique = ShadowTechnique::Planar;
    desk.run_steps(3);
    assert_eq!(click(&mut desk, "Choose planes"), [Action::SelectTool(Tool::Receiver)]);
    assert_eq!(click(&mut desk, "Choose casters"), [Action::SelectTool(Tool::Caster)]);
    desk.state_mut().panels.light.shadows.planar.casters.insert(InstanceId(1));
    desk.run_steps(3);
    click(&mut desk, "Choose none");
    assert!(desk.state().panels.light.shadows.planar.casters.is_empty());
}

#[test]
fn a_known_fault_and_the_time_of_each_pass_are_told() {
    let facts = Facts {
        shadows: ShadowFacts {
            fault: Some("wrong from here"),
            laps: &[("depth prepass", 1.25)],
            ..ShadowFacts::default()
        },
        ..baked()
    };
    let desk = live(facts);
    assert!(desk.query_all_by_label("wrong from here").next().is_some());
    assert!(desk.query_by_label("depth prepass").is_some() && desk.query_by_label("1.2 ms").is_some());
    assert!(desk.query_by_label("the device has no clock").is_some());
}
