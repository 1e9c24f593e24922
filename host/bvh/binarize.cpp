#include "host/bvh/binarize.hpp"

#include <array>

#include "host/base/parallel.hpp"
#include "host/bvh/box.hpp"

namespace wedge::bvh {
namespace {

constexpr int kWidth = 8;

/// A child of a binary node to be: an inner or outer child of the wide node, or a binary node that
/// joins two others.
struct Cluster {
    Box box;
    int32_t child;  ///< of the wide node if `is_joined` is false, else index from the first node
    bool is_joined;
};

struct Clusters {
    std::array<Cluster, kWidth> items;
    int count = 0;
};

Clusters children_of(const shared::BvhNode& node) {
    Clusters clusters;
    for (int i = 0; i < kWidth; ++i) {
        if (node.bounds[0][i] > node.bounds[1][i]) continue;
        Box box;
        box.lower = Float4{node.bounds[0][i], node.bounds[2][i], node.bounds[4][i], 0};
        box.upper = Float4{node.bounds[1][i], node.bounds[3][i], node.bounds[5][i], 0};
        clusters.items[clusters.count++] = {box, node.child[i], false};
    }
    return clusters;
}

void set_child(shared::BinaryNode& node, int side, const Box& box, int32_t child) {
    for (int axis = 0; axis < 3; ++axis) {
        node.bounds[axis][2 * side] = box.lower[axis];
        node.bounds[axis][2 * side + 1] = box.upper[axis];
    }
    node.child[side] = child;
}

/// The two whose common box is smallest.
std::array<int, 2> closest_pair(const Clusters& clusters, float scale) {
    std::array<int, 2> best{0, 1};
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < clusters.count; ++i)
        for (int j = i + 1; j < clusters.count; ++j) {
            Box both = clusters.items[i].box;
            both.include(clusters.items[j].box);
            const float area = half_area(both, scale);
            if (area >= least) continue;
            least = area;
            best = {i, j};
        }
    return best;
}

/// Binary nodes that a wide node becomes: one less than it has children, and one at least.
std::size_t node_count(const shared::BvhNode& node) {
    std::size_t used = 0;
    for (int i = 0; i < kWidth; ++i) used += node.bounds[0][i] <= node.bounds[1][i];
    return std::max<std::size_t>(used, 2) - 1;
}

/// Joins the closest pair until one node is left, which gets the first place. `first_of`: place of
/// the binary nodes of each wide one.
void write_nodes(const shared::BvhNode& wide, const std::vector<uint32_t>& first_of, uint32_t first,
                 float scale, shared::BinaryNode* out) {
    Clusters clusters = children_of(wide);
    const auto index_of = [&](const Cluster& c) {
        if (c.is_joined) return int32_t(first) + c.child;
        return c.child >= 0 ? int32_t(first_of[c.child]) : c.child;
    };
    const Cluster nothing{Box(), 0, false};
    if (clusters.count < 2) {
        *out = {};
        set_child(*out, 0, clusters.count ? clusters.items[0].box : nothing.box,
                  clusters.count ? index_of(clusters.items[0]) : 0);
        set_child(*out, 1, nothing.box, 0);
        return;
    }
    for (int place = clusters.count - 2; place >= 0; --place) {
        const auto [i, j] = closest_pair(clusters, scale);
        const Cluster a = clusters.items[i], b = clusters.items[j];
        out[place] = {};
        set_child(out[place], 0, a.box, index_of(a));
        set_child(out[place], 1, b.box, index_of(b));
        Cluster joined{a.box, place, true};
        joined.box.include(b.box);
        clusters.items[i] = joined;
        clusters.items[j] = clusters.items[--clusters.count];
    }
}

}  // namespace

RawVector<shared::BinaryNode> binarize(const Bvh& tree) {
    std::vector<uint32_t> first_of(tree.nodes.size());
    std::size_t total = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        first_of[i] = uint32_t(total);
        total += node_count(tree.nodes[i]);
    }
    const Vec3 extent = tree.bounds.empty() ? Vec3(1) : tree.bounds.extent();
    const float largest = glm::max(glm::max(extent.x, extent.y), extent.z);
    const float scale = 1 / largest > 0 && std::isfinite(1 / largest) ? 1 / largest : 1.0f;
    RawVector<shared::BinaryNode> nodes(total);
    parallel_ranges(tree.nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            write_nodes(tree.nodes[i], first_of, first_of[i], scale, nodes.data() + first_of[i]);
    });
    return nodes;
}

}  // namespace wedge::bvh
