//! Tests of the section Scene.

use super::*;

/// Returns a scene of a file with two material variants.
fn shop() -> &'static Scene {
    static SCENE: std::sync::OnceLock<Scene> = std::sync::OnceLock::new();
    SCENE.get_or_init(|| Scene { variants: ["oak", "walnut"].map(str::to_owned).to_vec(), ..builtin::cornell() })
}

#[test]
fn a_variant_of_the_file_is_chosen_from_its_list() {
    let facts = Facts { scene: SceneFacts { open: Some(shop()), variant: Some("oak"), ..baked().scene }, ..baked() };
    let mut window = window(facts);
    click(&mut window, "Place");
    assert!(click(&mut window, "Variant").is_empty());
    assert_eq!(click(&mut window, "walnut"), [Action::SetVariant(Some("walnut".to_owned()))]);
    click(&mut window, "Variant");
    assert_eq!(click(&mut window, "as it comes"), [Action::SetVariant(None)]);
    let mut without = super::window(baked());
    click(&mut without, "Place");
    assert!(without.query_by_label("Variant").is_none(), "a file without variants has no list of them");
}
