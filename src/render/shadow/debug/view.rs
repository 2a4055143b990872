//! The debug views, in one table that the command line and the panels use.

/// The data of a technique that a debug view shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DebugView {
    /// The stencil before light is added: the number of volumes, or of planar shadows, that a point lies in.
    StencilCounts,
    /// Sides of the shadow volumes as translucent hulls.
    Volumes,
    /// Outlines of the casters, seen from the light.
    Silhouettes,
    /// Depth in the shadow map: near is bright, empty texels are blue.
    Map,
    /// Planes that receive planar shadows, each in a colour.
    Receivers,
}

/// A row of [`DebugView::ALL`].
#[derive(Clone, Copy, Debug)]
pub struct DebugViewInfo {
    /// The view.
    pub view: DebugView,
    /// Name on the command line.
    pub name: &'static str,
    /// Name in the panels.
    pub title: &'static str,
    /// One line of explanation.
    pub hint: &'static str,
}

impl DebugView {
    /// All debug views, in the order in which they are listed.
    pub const ALL: [DebugViewInfo; 5] = [
        DebugViewInfo {
            view: DebugView::StencilCounts,
            name: "stencil-counts",
            title: "Stencil counts",
            hint: "In how many shadow volumes, or under how many planar shadows, each point is",
        },
        DebugViewInfo {
            view: DebugView::Volumes,
            name: "volumes",
            title: "Volumes",
            hint: "Sides of the shadow volumes as translucent hulls",
        },
        DebugViewInfo {
            view: DebugView::Silhouettes,
            name: "silhouettes",
            title: "Silhouettes",
            hint: "Outlines of the casters, seen from the light",
        },
        DebugViewInfo {
            view: DebugView::Map,
            name: "map",
            title: "Shadow map",
            hint: "Depth in the faces of the shadow map: near is bright, empty texels are blue",
        },
        DebugViewInfo {
            view: DebugView::Receivers,
            name: "receivers",
            title: "Planes",
            hint: "Planes that receive planar shadows, outlined",
        },
    ];

    /// Returns the view's row of the table.
    #[must_use]
    pub fn info(self) -> &'static DebugViewInfo {
        const ALL: &[DebugViewInfo] = &DebugView::ALL;
        ALL.iter().find(|info| info.view == self).unwrap_or(&ALL[0])
    }

    /// Returns the view with a name of the command line.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|info| info.name == name).map(|info| info.view)
    }
}

/// A debug view of one light sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadowDebug {
    /// The data that is shown.
    pub view: DebugView,
    /// Index of the light sample; an index beyond the last sample shows the last.
    pub light: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_one_row_for_each_view() {
        for (index, info) in DebugView::ALL.iter().enumerate() {
            assert_eq!(info.view as usize, index, "rows are in the order of the enum");
            assert_eq!(DebugView::from_name(info.name), Some(info.view));
        }
        assert_eq!(DebugView::ALL.len(), DebugView::Receivers as usize + 1);
    }
}
