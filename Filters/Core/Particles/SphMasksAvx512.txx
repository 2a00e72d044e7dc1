// SPDX-License-Identifier: BSD-3-Clause
// Yes or no for each of eight lanes, as AVX-512 has it: in a register of masks.
struct LaneMask
{
  __mmask8 Value;

  unsigned Bits() const { return this->Value; }
};

inline LaneMask operator<(Lanes a, Lanes b)
{
  return { _mm256_cmp_ps_mask(a.Value, b.Value, _CMP_LT_OQ) };
}
/// The lanes `first` (0 to 8) and on.
inline LaneMask LanesFrom(unsigned first)
{
  return { static_cast<__mmask8>(0xFFu << first) };
}
inline Lanes Select(LaneMask mask, Lanes yes, Lanes no)
{
  return { _mm256_mask_blend_ps(mask.Value, no.Value, yes.Value) };
}
