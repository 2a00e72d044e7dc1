// SPDX-License-Identifier: BSD-3-Clause
// Yes or no for each of eight lanes, as AVX2 has it: in the sign bits of a register.
struct LaneMask
{
  __m256 Value;

  unsigned Bits() const { return static_cast<unsigned>(_mm256_movemask_ps(this->Value)); }
};

inline LaneMask operator<(Lanes a, Lanes b)
{
  return { _mm256_cmp_ps(a.Value, b.Value, _CMP_LT_OQ) };
}
/// The lanes `first` (0 to 8) and on.
inline LaneMask LanesFrom(unsigned first)
{
  static constexpr std::int32_t Steps[16] = { 0,  0,  0,  0,  0,  0,  0,  0,
                                              -1, -1, -1, -1, -1, -1, -1, -1 };
  return { _mm256_castsi256_ps(
    _mm256_loadu_si256(reinterpret_cast<const __m256i*>(Steps + 8 - first))) };
}
inline Lanes Select(LaneMask mask, Lanes yes, Lanes no)
{
  return { _mm256_blendv_ps(no.Value, yes.Value, mask.Value) };
}
