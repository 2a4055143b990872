//! Takes the place of branches that are not merged yet: a box room, and a bake of unoccluded direct light.

use std::path::Path;
use std::time::Duration;

use glam::{Vec2, Vec3, Vec4};

use crate::bake::Watch;
use crate::baked::{BakedScene, VertexLight};
use crate::base::ids::{GroupId, InstanceId, MaterialId};
use crate::base::progress::Stage;
use crate::gpu::Gpu;
use crate::scene::{Camera, Instance, Light, LightKind, Material, Scene, Triangle, Vertex};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality { Draft, #[default] Medium, High }
#[derive(Clone, Copy, Debug, PartialEq)]
#[derive(Default)]
pub struct BakeSettings { pub quality: Quality }
impl BakeSettings { pub fn preset(quality: Quality) -> Self { Self { quality } } }
pub struct Report { pub unshot_share: f64, pub hemicubes: usize, pub patches: usize }
pub struct Bake { pub baked: BakedScene, pub report: Report }

pub fn bake(_gpu: &Gpu, scene: &Scene, _settings: &BakeSettings, watch: &dyn Watch) -> anyhow::Result<Bake> {
    watch.report(Stage::Mesh, 0.0);
    let mut baked = BakedScene { scene: scene.clone(), light: VertexLight::dark(scene.light_groups.len(), scene.vertices.len()) };
    watch.mesh(&baked);
    const STEPS: usize = 400;
    for step in 1..=STEPS {
        if watch.is_cancelled() { break; }
        for (v, vertex) in scene.vertices.iter().enumerate() {
            for light in &scene.lights {
                let a = light.arrival(vertex.position);
                let e = a.irradiance * a.to_light.dot(vertex.normal).max(0.0);
                baked.light.groups[light.group.index()].direct[v] += e / STEPS as f32;
                baked.light.groups[light.group.index()].indirect[v] += e * 0.2 / STEPS as f32;
            }
        }
        let end = std::time::Instant::now() + Duration::from_millis(12);
        while std::time::Instant::now() < end { std::hint::spin_loop(); }
        watch.report(Stage::Solve, step as f32 / STEPS as f32);
        if watch.wants_light() { watch.light(&baked.light); }
        watch.rest();
    }
    Ok(Bake { baked, report: Report { unshot_share: 0.001, hemicubes: 1234567, patches: 1500 } })
}

pub fn from_scene(_: Scene) -> Option<BakedScene> { None }
pub fn load(path: &Path) -> anyhow::Result<Scene> {
    let bytes = std::fs::read(path).map_err(|e| anyhow::anyhow!("cannot read {}: {e}", path.display()))?;
    anyhow::ensure!(bytes.starts_with(b"glTF"), "{} is not glTF: it begins with other bytes", path.display());
    Ok(gallery())
}

pub fn gallery() -> Scene {
    let mut s = Scene { name: "box room".into(), light_groups: vec!["lamp".into(), "window".into()], ..Scene::default() };
    for (name, c) in [("white", Vec3::splat(0.75)), ("red", Vec3::new(0.7, 0.2, 0.15)), ("green", Vec3::new(0.2, 0.6, 0.2))] {
        s.materials.push(Material { name: name.into(), base_colour: c.extend(1.0), ..Material::default() });
    }
    let room = (Vec3::new(-4.0, 0.0, -4.0), Vec3::new(4.0, 3.0, 4.0));
    cuboid(&mut s, room, true, [1, 2, 0, 0, 0, 0]);
    for i in 0..6 {
        let f = i as f32;
        cuboid(&mut s, (Vec3::new(1.0, 0.0, -2.0 - 0.3 * f), Vec3::new(3.0, 0.2 * (f + 1.0), -1.7 - 0.3 * f)), false, [0; 6]);
    }
    cuboid(&mut s, (Vec3::new(-2.5, 0.0, -2.0), Vec3::new(-1.5, 1.0, -1.0)), false, [1; 6]);
    cuboid(&mut s, (Vec3::new(-0.5, 0.0, 1.0), Vec3::new(-0.45, 3.0, 3.0)), false, [2; 6]);
    s.instances.push(Instance { name: "room".into(), triangles: 0..s.triangles.len() });
    let lamp = |name: &str, position, c: Vec3, g| Light { name: name.into(), kind: LightKind::Point { position }, intensity: c, range: None, group: GroupId(g) };
    s.lights.push(lamp("lamp", Vec3::new(0.0, 2.6, 0.0), Vec3::new(8.0, 7.0, 5.0), 0));
    s.lights.push(lamp("window", Vec3::new(-3.0, 2.0, 3.0), Vec3::new(2.0, 3.0, 5.0), 1));
    s.cameras.push(Camera::looking_at("entrance", Vec3::new(0.0, 1.65, 3.5), Vec3::new(0.0, 1.4, 0.0), 1.0));
    s.cameras.push(Camera::looking_at("from above", Vec3::new(-3.5, 2.8, 3.5), Vec3::new(1.0, 0.0, -2.0), 1.2));
    s
}

fn cuboid(s: &mut Scene, (low, high): (Vec3, Vec3), inward: bool, materials: [u32; 6]) {
    for (face, &material) in materials.iter().enumerate() {
        let axis = face / 2;
        let sign = if face % 2 == 0 { -1.0 } else { 1.0 };
        let mut n = Vec3::ZERO; n[axis] = sign;
        let (u, w) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut eu = Vec3::ZERO; eu[u] = high[u] - low[u];
        let mut ew = Vec3::ZERO; ew[w] = high[w] - low[w];
        let mut o = low; if sign > 0.0 { o[axis] = high[axis]; }
        const N: usize = 12;
        let normal = if inward { -n } else { n };
        let flip = (sign > 0.0) == inward;
        let first = s.vertices.len() as u32;
        for j in 0..=N { for i in 0..=N {
            let p = o + eu * (i as f32 / N as f32) + ew * (j as f32 / N as f32);
            s.vertices.push(Vertex { position: p, normal, uv: [Vec2::ZERO; 2], colour: Vec4::ONE });
        } }
        for j in 0..N as u32 { for i in 0..N as u32 {
            let a = first + j * (N as u32 + 1) + i; let (b, c, d) = (a + 1, a + N as u32 + 2, a + N as u32 + 1);
            for t in [[a, b, c], [a, c, d]] {
                let t = if flip { [t[0], t[2], t[1]] } else { t };
                s.triangles.push(Triangle { vertices: t, material: MaterialId(material), instance: InstanceId(0), is_back_side: false });
            }
        } }
    }
}
