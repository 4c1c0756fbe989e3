#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>

#include "bakers/character/initialise.h"

namespace nook::bake {
namespace {

struct BoneWeight {
  std::uint16_t bone;
  float weight;
};

// The mean of a cluster in feature space. Skin weights are sparse and sorted by bone.
struct Cluster {
  float size = 0;
  Vec3 position, normal;
  std::vector<BoneWeight> weights;
  std::set<std::uint32_t> neighbours;
  std::uint32_t version = 0;  // a queue entry with an older version is outdated
  bool alive = true;
};

float weight_distance2(const std::vector<BoneWeight>& a, const std::vector<BoneWeight>& b) {
  float sum = 0;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    float d;
    if (j == b.size() || (i < a.size() && a[i].bone < b[j].bone))
      d = a[i++].weight;
    else if (i == a.size() || b[j].bone < a[i].bone)
      d = b[j++].weight;
    else
      d = a[i++].weight - b[j++].weight;
    sum += d * d;
  }
  return sum;
}

std::vector<BoneWeight> blend(const std::vector<BoneWeight>& a, float wa, const std::vector<BoneWeight>& b,
                              float wb) {
  std::vector<BoneWeight> out;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i].bone < b[j].bone)) {
      out.push_back({a[i].bone, wa * a[i].weight});
      ++i;
    } else if (i == a.size() || b[j].bone < a[i].bone) {
      out.push_back({b[j].bone, wb * b[j].weight});
      ++j;
    } else {
      out.push_back({a[i].bone, wa * a[i].weight + wb * b[j].weight});
      ++i;
      ++j;
    }
  }
  return out;
}

std::vector<BoneWeight> sparse_weights(const SkinWeights& w) {
  std::vector<BoneWeight> out;
  for (int s = 0; s < SkinWeights::max_bones; ++s)
    if (w.weight[s] > 0) out.push_back({w.bone[s], w.weight[s]});
  std::sort(out.begin(), out.end(), [](BoneWeight a, BoneWeight b) { return a.bone < b.bone; });
  return out;
}

float body_size(std::span<const Vec3> positions) {
  Vec3 low = positions.front(), high = low;
  for (Vec3 p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return std::max(length(high - low), 1e-6f);
}

// Returns pairs of vertices that are nearer than `reach` and have similar weights. They connect parts of a
// body that share no edge (appendix B).
std::vector<std::pair<std::uint32_t, std::uint32_t>> near_pairs(const SkinnedMesh& mesh,
                                                                const std::vector<Cluster>& clusters,
                                                                float reach) {
  std::map<std::array<int, 3>, std::vector<std::uint32_t>> cells;
  const auto cell = [&](Vec3 p) {
    return std::array<int, 3>{int(std::floor(p.x / reach)), int(std::floor(p.y / reach)),
                              int(std::floor(p.z / reach))};
  };
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) cells[cell(mesh.position[i])].push_back(i);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  constexpr std::size_t most = 6;  // extra edges per vertex, enough to connect parts
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    const auto c = cell(mesh.position[i]);
    std::vector<std::pair<float, std::uint32_t>> near;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto found = cells.find({c[0] + x, c[1] + y, c[2] + z});
          if (found == cells.end()) continue;
          for (std::uint32_t j : found->second) {
            const float d = length(mesh.position[i] - mesh.position[j]);
            if (j > i && d < reach && weight_distance2(clusters[i].weights, clusters[j].weights) < 0.05f)
              near.push_back({d, j});
          }
        }
    std::sort(near.begin(), near.end());
    for (std::size_t k = 0; k < std::min(most, near.size()); ++k) pairs.push_back({i, near[k].second});
  }
  return pairs;
}

// A graph of clusters. It repeatedly merges the two neighbours that cost least.
class ClusterGraph {
 public:
  // At the start, each vertex is a cluster of its own. Vertices that share an edge or are near to each other
  // are neighbours.
  ClusterGraph(const SkinnedMesh& mesh, std::span<const float> vertex_weight, std::span<const Vec3> normal,
               const ClusterSettings& settings)
      : alive_(mesh.vertex_count()) {
    const float size = body_size(mesh.position);
    position_scale2_ = std::pow(settings.position_scale / (0.1f * size), 2.0f);
    normal_scale2_ = settings.normal_scale * settings.normal_scale;
    weight_scale2_ = settings.weight_scale * settings.weight_scale;
    clusters_.resize(alive_);
    parent_.resize(alive_);
    for (std::uint32_t i = 0; i < alive_; ++i) {
      clusters_[i].size = std::max(vertex_weight[i], 1e-6f);
      clusters_[i].position = mesh.position[i];
      clusters_[i].normal = normal[i];
      clusters_[i].weights = sparse_weights(mesh.weights[i]);
      parent_[i] = i;
    }
    for (const auto& t : mesh.triangle) {
      connect(t[0], t[1]);
      connect(t[1], t[2]);
      connect(t[2], t[0]);
    }
    for (const auto& [a, b] : near_pairs(mesh, clusters_, 0.01f * size)) connect(a, b);
    for (std::uint32_t a = 0; a < clusters_.size(); ++a)
      for (std::uint32_t b : clusters_[a].neighbours)
        if (a < b) offer(a, b);
  }

  // Ends with more than `count` clusters only if no neighbours are left.
  void collapse_to(std::size_t count) {
    while (alive_ > count && !queue_.empty()) {
      const Collapse top = queue_.top();
      queue_.pop();
      const Cluster &a = clusters_[top.a], &b = clusters_[top.b];
      if (!a.alive || !b.alive || a.version != top.version_a || b.version != top.version_b) continue;
      merge(top.a, top.b);
      --alive_;
    }
  }

  // Returns the index of each vertex's cluster. Clusters are numbered in the order of their first vertices.
  std::vector<std::uint32_t> labels() const {
    std::vector<std::uint32_t> label(parent_.size()), number(parent_.size(), UINT32_MAX);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < label.size(); ++i) {
      std::uint32_t root = i;
      while (parent_[root] != root) root = parent_[root];
      if (number[root] == UINT32_MAX) number[root] = count++;
      label[i] = number[root];
    }
    return label;
  }

 private:
  struct Collapse {
    float cost;
    std::uint32_t a, b, version_a, version_b;
    bool operator<(const Collapse& o) const {
      return cost != o.cost ? cost > o.cost : a != o.a ? a > o.a : b > o.b;  // cheapest on top, ties by index
    }
  };

  void connect(std::uint32_t a, std::uint32_t b) {
    clusters_[a].neighbours.insert(b);
    clusters_[b].neighbours.insert(a);
  }

  // Returns by how much merging two clusters raises the sum of squared distances to the means (Ward 1963).
  float cost(const Cluster& a, const Cluster& b) const {
    const Vec3 dp = a.position - b.position, dn = a.normal - b.normal;
    const float d2 = position_scale2_ * dot(dp, dp) + normal_scale2_ * dot(dn, dn) +
                     weight_scale2_ * weight_distance2(a.weights, b.weights);
    return a.size * b.size / (a.size + b.size) * d2;
  }

  void offer(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    queue_.push({cost(clusters_[a], clusters_[b]), a, b, clusters_[a].version, clusters_[b].version});
  }

  void merge(std::uint32_t kept, std::uint32_t gone) {
    Cluster &a = clusters_[kept], &b = clusters_[gone];
    const float total = a.size + b.size, wa = a.size / total, wb = b.size / total;
    a.position = wa * a.position + wb * b.position;
    a.normal = wa * a.normal + wb * b.normal;
    a.weights = blend(a.weights, wa, b.weights, wb);
    a.size = total;
    ++a.version;
    b.alive = false;
    parent_[gone] = kept;
    for (std::uint32_t n : b.neighbours) {
      clusters_[n].neighbours.erase(gone);
      if (n != kept) connect(n, kept);
    }
    a.neighbours.erase(gone);
    b.neighbours.clear();
    for (std::uint32_t n : a.neighbours) offer(kept, n);
  }

  float position_scale2_, normal_scale2_, weight_scale2_;
  std::size_t alive_;
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> parent_;  // the cluster that this one was merged into, or itself
  std::priority_queue<Collapse> queue_;
};

}  // namespace

std::vector<std::uint32_t> cluster_vertices(const SkinnedMesh& mesh, std::span<const float> vertex_weight,
                                            std::span<const Vec3> normal, const ClusterSettings& settings) {
  ClusterGraph graph(mesh, vertex_weight, normal, settings);
  graph.collapse_to(settings.count);
  return graph.labels();
}

}  // namespace nook::bake
