//! The list of what is in the scene.

use super::*;

/// A scene of a file with two material variants.
fn shop() -> &'static Scene {
    static SCENE: std::sync::OnceLock<Scene> = std::sync::OnceLock::new();
    SCENE.get_or_init(|| Scene { variants: ["oak", "walnut"].map(str::to_owned).to_vec(), ..builtin::cornell() })
}

#[test]
fn a_variant_of_the_file_is_chosen_from_its_list() {
    let facts = Facts { scene: SceneFacts { open: Some(shop()), variant: Some("oak"), ..baked().scene }, ..baked() };
    let mut desk = desk(facts);
    click(&mut desk, "Place");
    assert!(click(&mut desk, "Variant").is_empty());
    assert_eq!(click(&mut desk, "walnut"), [Action::SetVariant(Some("walnut".to_owned()))]);
    click(&mut desk, "Variant");
    assert_eq!(click(&mut desk, "as it comes"), [Action::SetVariant(None)]);
    let mut without = super::desk(baked());
    click(&mut without, "Place");
    assert!(without.query_by_label("Variant").is_none(), "a choice of nothing");
}
