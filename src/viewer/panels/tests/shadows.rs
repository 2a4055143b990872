//! Tests of the section Shadows and of the labels over its picture.

use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use super::super::*;
use super::{Fixture, baked, click, window};
use crate::base::ids::InstanceId;
use crate::render::ShadowTechnique;
use crate::render::shadow::DebugView;
use crate::viewer::action::Action;
use crate::viewer::settings::comparison::ComparisonLayout;
use crate::viewer::settings::tool::Tool;

fn live(facts: Facts<'static>) -> Harness<'static, Fixture> {
    let mut window = window(facts);
    window.state_mut().panels.light.is_real_time = true;
    window.run_steps(3);
    window
}

/// Chooses `entry` of the combo box `list`.
fn choose(window: &mut Harness<'static, Fixture>, list: &str, entry: &str) {
    click(window, list);
    // If the closed combo box shows the same text, the entry of the list is the last match.
    window.get_all_by_label(entry).last().expect("an entry").click();
    window.run_steps(3);
}

#[test]
fn shadows_are_compared_and_debugged() {
    let mut window = live(Facts { shadows: ShadowFacts { num_light_samples: 7, ..ShadowFacts::default() }, ..baked() });
    choose(&mut window, "Compare with", "Ray-traced");
    let compared = window.state().panels.light.compared_shadows().expect("compared shadows");
    assert_eq!(compared.settings.technique, ShadowTechnique::Raytraced);
    click(&mut window, "Difference");
    assert_eq!(window.state().panels.light.comparison_layout, ComparisonLayout::Difference);
    choose(&mut window, "Look into", "Stencil counts");
    let debug = window.state().panels.light.render_settings(true).shadow_debug.expect("a debug view");
    assert_eq!((debug.view, debug.light), (DebugView::StencilCounts, 0));
    assert!(window.query_by_label("Light that is shown").is_some() && window.query_by_label("of 7").is_some());
    for name in ["points a lamp", "radius of lamps"] {
        assert!(window.query_all_by_label(name).next().is_some(), "{name}");
    }
}

#[test]
fn the_divider_of_a_split_screen_is_dragged() {
    let mut window = live(baked());
    window.state_mut().panels.light.compared_technique = Some(ShadowTechnique::Map);
    window.run_steps(3);
    let free = window.state().free;
    let at = |x: f32| egui::pos2(x, free.center().y);
    assert!(window.query_by_label("Divider").is_some());
    window.drag_at(at(free.center().x));
    window.run_steps(1);
    window.hover_at(at(free.left() + 0.25 * free.width()));
    window.run_steps(1);
    window.drop_at(at(free.left() + 0.25 * free.width()));
    window.run_steps(2);
    let divider = window.state().panels.light.divider;
    assert!((divider - 0.25).abs() < 0.02, "{divider}");
}

#[test]
fn planes_and_casters_are_chosen_by_clicking() {
    let mut window = live(baked());
    window.state_mut().panels.light.shadows.technique = ShadowTechnique::Planar;
    window.run_steps(3);
    assert_eq!(click(&mut window, "Choose planes"), [Action::SelectTool(Tool::Receiver)]);
    assert_eq!(click(&mut window, "Choose casters"), [Action::SelectTool(Tool::Caster)]);
    window.state_mut().panels.light.shadows.planar.casters.insert(InstanceId(1));
    window.run_steps(3);
    click(&mut window, "Choose none");
    assert!(window.state().panels.light.shadows.planar.casters.is_empty());
}

#[test]
fn a_known_fault_and_the_time_of_each_pass_are_shown() {
    let facts = Facts {
        shadows: ShadowFacts {
            fault: Some("wrong from here"),
            laps: &[("depth prepass", 1.25)],
            ..ShadowFacts::default()
        },
        ..baked()
    };
    let window = live(facts);
    assert!(window.query_all_by_label("wrong from here").next().is_some());
    assert!(window.query_by_label("depth prepass").is_some() && window.query_by_label("1.2 ms").is_some());
    assert!(window.query_by_label("the device has no clock").is_some());
}
