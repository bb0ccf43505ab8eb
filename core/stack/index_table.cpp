#include "core/stack/index_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/math/simd_level.hpp"

namespace irido {

namespace {

/// See IndexTable::extraordinary().
std::vector<std::size_t> rows_of_extraordinary(const std::vector<Material>& materials) {
    std::vector<std::size_t> rows;
    std::size_t next = materials.size();
    for (std::size_t m = 0; m < materials.size(); ++m)
        rows.push_back(is_uniaxial(materials[m]) ? next++ : m);
    return rows;
}

std::size_t rows_in(const std::vector<std::size_t>& extraordinary) {
    std::size_t rows = extraordinary.size();
    for (const std::size_t row : extraordinary) rows = std::max(rows, row + 1);
    return rows;
}

}  // namespace

IndexTable::IndexTable(const Stack& stack, std::vector<double> wavelength_nm)
    : wavelength_nm_(std::move(wavelength_nm)),
      materials_(stack.materials.size()),
      incident_(stack.incident),
      extraordinary_(rows_of_extraordinary(stack.materials)),
      rows_(rows_in(extraordinary_)),
      n_(wavelength_nm_.size() * rows_ + kMostLanes, 1),
      k_(n_.size(), 0),
      k0_(wavelength_nm_.size() + kMostLanes, 1),
      constant_(materials_, true),
      absorbs_(materials_, false),
      amplifies_(materials_, false) {
    const std::size_t count = wavelength_nm_.size();
    double largest_k0 = 0, largest_index = 0;
    for (std::size_t w = 0; w < count; ++w) {
        require_in_range("wavelength_nm", wavelength_nm_[w], kAllWavelengths.first_nm,
                         kAllWavelengths.last_nm);
        k0_[w] = 2 * std::numbers::pi / wavelength_nm_[w];
        largest_k0 = std::max(largest_k0, k0_[w]);
    }
    for (std::size_t m = 0; m < materials_; ++m) {
        const Material& material = stack.materials[m];
        const bool constant = irido::is_constant(material);
        const auto fill = [&](std::size_t row, auto&& at) {
            Complex index;
            for (std::size_t w = 0; w < count; ++w) {
                if (w == 0 || !constant) {
                    index = at(material, wavelength_nm_[w]);
                    largest_index =
                        std::max(largest_index, std::abs(index.real()) + std::abs(index.imag()));
                }
                n_[row * count + w] = index.real();
                k_[row * count + w] = index.imag();
                if (index != this->index(row, 0)) constant_[m] = false;
                if (index.imag() != 0) absorbs_[m] = true;
                if (index.imag() < 0) amplifies_[m] = true;
            }
        };
        fill(m, index_at);
        if (extraordinary_[m] != m) fill(extraordinary_[m], extraordinary_index_at);
    }
    largest_wavenumber_ = largest_k0 * largest_index;
    for (std::size_t w = 0; w < count; ++w) {
        const Complex incident = index(incident_, w);
        if (incident.real() > 0 && std::abs(incident.imag()) < kTransparentBelow_k) continue;
        throw DomainError("the incident medium must be transparent, |k| below 1e-3 (got n = " +
                          to_text(incident.real()) + ", k = " + to_text(incident.imag()) + " at " +
                          to_text(wavelength_nm_[w]) + " nm)");
    }
}

void IndexTable::replace(std::size_t material, std::span<const Complex> index) {
    const std::size_t count = wavelength_nm_.size();
    for (std::size_t w = 0; w < count; ++w) {
        n_[material * count + w] = index[w].real();
        k_[material * count + w] = index[w].imag();
        if (index[w] != index[0]) constant_[material] = false;
        if (index[w].imag() != 0) absorbs_[material] = true;
        if (index[w].imag() < 0) amplifies_[material] = true;
        largest_wavenumber_ = std::max(
            largest_wavenumber_, k0_[w] * (std::abs(index[w].real()) + std::abs(index[w].imag())));
    }
}

void IndexTable::resize_like(const IndexTable& model, std::size_t count) {
    materials_ = model.materials_;
    extraordinary_ = model.extraordinary_;
    rows_ = model.rows_;
    incident_ = model.incident_;
    largest_wavenumber_ = 0;
    constant_ = model.constant_;
    absorbs_ = model.absorbs_;
    amplifies_ = model.amplifies_;
    wavelength_nm_.resize(count);
    n_.resize(count * rows_ + kMostLanes, 1);
    k_.resize(n_.size(), 0);
    k0_.resize(count + kMostLanes, 1);
}

void IndexTable::assign(const IndexTable& constant,
                        std::span<const std::vector<double>* const> wavelengths) {
    std::size_t count = 0;
    for (const std::vector<double>* some : wavelengths) count += some->size();
    resize_like(constant, count);
    std::size_t at = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::vector<double>* some : wavelengths) {
        for (const double wavelength : *some) {
            wavelength_nm_[at] = wavelength;
            k0_[at++] = 2 * std::numbers::pi / wavelength;
            shortest = std::min(shortest, wavelength);
        }
    }
    for (std::size_t m = 0; m < rows_; ++m) {
        const Complex index = constant.index(m, 0);
        std::fill_n(n_.data() + m * count, count, index.real());
        std::fill_n(k_.data() + m * count, count, index.imag());
    }
    largest_wavenumber_ = constant.largest_wavenumber_ * constant.wavelength_nm_[0] / shortest;
}

void IndexTable::assign(std::span<const IndexTable* const> parts) {
    const IndexTable& first = *parts.front();
    std::size_t count = 0;
    for (const IndexTable* part : parts) count += part->wavelength_nm_.size();
    resize_like(first, count);
    std::size_t at = 0;
    for (const IndexTable* part : parts) {
        const std::size_t some = part->wavelength_nm_.size();
        std::copy_n(part->wavelength_nm_.data(), some, wavelength_nm_.data() + at);
        std::copy_n(part->k0_.data(), some, k0_.data() + at);
        for (std::size_t m = 0; m < rows_; ++m) {
            std::copy_n(part->n_.data() + m * some, some, n_.data() + m * count + at);
            std::copy_n(part->k_.data() + m * some, some, k_.data() + m * count + at);
        }
        for (std::size_t m = 0; m < materials_; ++m) {
            const std::size_t e = extraordinary_[m];
            if (part->index(m, 0) != first.index(m, 0) || part->index(e, 0) != first.index(e, 0) ||
                !part->constant_[m])
                constant_[m] = false;
            if (part->absorbs_[m]) absorbs_[m] = true;
            if (part->amplifies_[m]) amplifies_[m] = true;
        }
        largest_wavenumber_ = std::max(largest_wavenumber_, part->largest_wavenumber_);
        at += some;
    }
}

}  // namespace irido
