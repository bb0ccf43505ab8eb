#include "core/color/quadrature/point_indices.hpp"

namespace irido {

const IndexTable& PointIndices::assign(std::optional<IndexTable>& table, const IndexTable& constant,
                                       std::span<const std::vector<double>* const> wavelengths) {
    if (!table) table = constant;
    table->assign(constant, wavelengths);
    return *table;
}

const IndexTable& PointIndices::at(std::span<const SpectralPoints* const> parts,
                                   const IndexTable* constant) {
    if (constant) {
        wavelengths_.clear();
        for (const SpectralPoints* part : parts) wavelengths_.push_back(&part->wavelength_nm);
        return assign(several_, *constant, wavelengths_);
    }
    if (parts.size() == 1) return *parts[0]->indices;
    tables_.clear();
    for (const SpectralPoints* part : parts) tables_.push_back(part->indices.get());
    if (!several_) several_ = *tables_.front();
    several_->assign(tables_);
    return *several_;
}

const IndexTable& PointIndices::at_first(const SpectralPoints& first, const IndexTable* constant,
                                         std::size_t owner) {
    if (!constant) return *first.indices;
    if (first_points_ == &first && first_owner_ == owner) return *first_;
    const std::vector<double>* const wavelengths = &first.wavelength_nm;
    first_points_ = &first;
    first_owner_ = owner;
    return assign(first_, *constant, {&wavelengths, 1});
}

}  // namespace irido
