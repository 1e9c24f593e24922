// MTL material libraries.
#pragma once

#include <tiny_obj_loader.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/scene/texture_set.hpp"
#include "wedge/scene.hpp"

namespace wedge::scene {

/// Gives the OBJ parser the libraries an OBJ names, found as textures are. Missing ones are warned
/// about. The parser's own reading of `mtllib` lines loses backslashes and blanks, so the lines are
/// handed in as they stand in the file.
class MtlReader : public tinyobj::MaterialReader {
  public:
    MtlReader(const std::filesystem::path& obj, const LoadOptions& options,
              std::vector<std::string> mtllib_lines);

    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* index_of, std::string* warning,
                    std::string* error) override;

    /// For each material, the library it is from.
    const std::vector<std::filesystem::path>& file_of() const { return file_of_; }

  private:
    std::vector<std::filesystem::path> find_libraries(const std::string& line) const;

    std::filesystem::path obj_;
    const LoadOptions& options_;
    std::vector<std::string> lines_;
    bool done_ = false;
    std::vector<std::filesystem::path> file_of_;
};

/// Materials of MTL in this renderer's terms. What has no counterpart (transparency) is warned
/// about once for all. `normal_maps`: false leaves bump and normal maps out.
std::vector<Material> convert_materials(const std::vector<tinyobj::material_t>& materials,
                                        const std::vector<std::filesystem::path>& file_of,
                                        TextureSet& textures, bool normal_maps);

}  // namespace wedge::scene
