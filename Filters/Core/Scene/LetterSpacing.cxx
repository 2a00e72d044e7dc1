// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/LetterSpacing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

namespace waft
{

namespace
{

constexpr float InkLevel = 0.05f;

struct Letter
{
  std::vector<int> Labels; // of the connected parts
  int Left = 0;
  int Right = 0;
  int Lowest = 0;
  int Highest = 0;
};

// Numbers the connected parts of the ink (8 neighbours); -1: no ink.
std::vector<int> LabelInk(const Picture& text, std::vector<Letter>& parts)
{
  std::vector<int> labels(text.Pixels.size(), -1);
  for (std::size_t start = 0; start < labels.size(); ++start)
  {
    if (labels[start] >= 0 || text.Pixels[start][3] < InkLevel)
    {
      continue;
    }
    const int label = static_cast<int>(parts.size());
    Letter part;
    part.Labels = { label };
    part.Left = text.Width;
    part.Right = -1;
    part.Lowest = text.Height;
    part.Highest = -1;
    std::vector<std::size_t> open{ start };
    labels[start] = label;
    while (!open.empty())
    {
      const auto x = static_cast<int>(open.back() % static_cast<std::size_t>(text.Width));
      const auto y = static_cast<int>(open.back() / static_cast<std::size_t>(text.Width));
      open.pop_back();
      part.Left = std::min(part.Left, x);
      part.Right = std::max(part.Right, x);
      part.Lowest = std::min(part.Lowest, y);
      part.Highest = std::max(part.Highest, y);
      for (int v = std::max(0, y - 1); v <= std::min(text.Height - 1, y + 1); ++v)
      {
        for (int u = std::max(0, x - 1); u <= std::min(text.Width - 1, x + 1); ++u)
        {
          const std::size_t next = static_cast<std::size_t>(v) * text.Width + u;
          if (labels[next] < 0 && text.Pixels[next][3] >= InkLevel)
          {
            labels[next] = label;
            open.push_back(next);
          }
        }
      }
    }
    parts.push_back(std::move(part));
  }
  return labels;
}

// Parts that have in common most of their width are one letter; letters from left to right.
std::vector<Letter> JoinParts(std::vector<Letter> parts)
{
  std::sort(parts.begin(), parts.end(),
            [](const Letter& a, const Letter& b) { return a.Left + a.Right < b.Left + b.Right; });
  std::vector<Letter> letters;
  for (const Letter& part : parts)
  {
    if (!letters.empty())
    {
      Letter& last = letters.back();
      const int shared = std::min(last.Right, part.Right) - std::max(last.Left, part.Left) + 1;
      if (2 * shared > std::min(last.Right - last.Left, part.Right - part.Left) + 1)
      {
        last.Labels.insert(last.Labels.end(), part.Labels.begin(), part.Labels.end());
        last.Left = std::min(last.Left, part.Left);
        last.Right = std::max(last.Right, part.Right);
        continue;
      }
    }
    letters.push_back(part);
  }
  return letters;
}

// The lowest rows of the lines of a text, from the top: the widest blank bands part them.
std::vector<int> BottomsOfLines(const Picture& text, const std::vector<Letter>& parts, int lines)
{
  std::vector<char> isInked(static_cast<std::size_t>(text.Height), 0);
  for (const Letter& part : parts)
  {
    std::fill(isInked.begin() + part.Lowest, isInked.begin() + part.Highest + 1, 1);
  }
  std::vector<std::pair<int, int>> bands; // blank rows below ink: less their number, the lowest ink
  int blank = -1;                         // none yet
  for (int y = 0; y < text.Height; ++y)
  {
    if (isInked[static_cast<std::size_t>(y)] && blank > 0)
    {
      bands.emplace_back(-blank, y);
    }
    blank = isInked[static_cast<std::size_t>(y)] ? 0 : blank < 0 ? -1 : blank + 1;
  }
  std::vector<int> bottoms;
  std::sort(bands.begin(), bands.end());
  const bool areParted = static_cast<int>(bands.size()) >= lines - 1;
  for (int line = 0; line + 1 < lines; ++line)
  {
    bottoms.push_back(areParted ? bands[static_cast<std::size_t>(line)].second
                                : (line + 1) * text.Height / lines);
  }
  bottoms.push_back(0);
  std::sort(bottoms.rbegin(), bottoms.rend());
  return bottoms;
}

// Of the letters of a line the first ones of its words: behind the widest gaps.
std::vector<std::size_t> FirstLetters(const std::vector<Letter>& letters, std::size_t words)
{
  std::vector<std::pair<int, std::size_t>> gaps; // less the pixels, the letter behind
  for (std::size_t l = 1; l < letters.size(); ++l)
  {
    gaps.emplace_back(letters[l - 1].Right - letters[l].Left, l);
  }
  std::sort(gaps.begin(), gaps.end());
  std::vector<std::size_t> first;
  for (std::size_t w = 0; w + 1 < words && w < gaps.size(); ++w)
  {
    first.push_back(gaps[w].second);
  }
  return first;
}

// Of each line of a text that is not blank the number of its words.
std::vector<std::size_t> WordsOfLines(const std::string& text)
{
  std::vector<std::size_t> words;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream stream(line);
    const auto count = static_cast<std::size_t>(std::distance(
      std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()));
    if (count > 0)
    {
      words.push_back(count);
    }
  }
  return words;
}

} // namespace

std::vector<TextPlace> PlacesInText(const Picture& drawn, const std::string& text,
                                    const std::vector<std::array<double, 2>>& pixels)
{
  std::vector<Letter> parts;
  const std::vector<int> labels = LabelInk(drawn, parts);
  const std::vector<std::size_t> words = WordsOfLines(text);
  const std::vector<int> bottoms =
    BottomsOfLines(drawn, parts, std::max(1, static_cast<int>(words.size())));
  std::vector<TextPlace> placeOf(parts.size());
  TextPlace place;
  for (std::size_t line = 0; line < bottoms.size(); ++line)
  {
    std::vector<Letter> own;
    for (const Letter& part : parts)
    {
      const int middle = (part.Lowest + part.Highest) / 2;
      if (middle >= bottoms[line] && (line == 0 || middle < bottoms[line - 1]))
      {
        own.push_back(part);
      }
    }
    const std::vector<Letter> letters = JoinParts(std::move(own));
    const std::vector<std::size_t> first =
      FirstLetters(letters, line < words.size() ? words[line] : 1);
    place.Line = static_cast<int>(line);
    for (std::size_t l = 0; l < letters.size(); ++l)
    {
      place.Word += std::count(first.begin(), first.end(), l) > 0 ? 1 : 0;
      for (const int label : letters[l].Labels)
      {
        placeOf[static_cast<std::size_t>(label)] = place;
      }
      ++place.Letter;
    }
    ++place.Word;
  }
  std::vector<std::pair<int, int>> inked;
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= 0)
    {
      const auto width = static_cast<std::size_t>(drawn.Width);
      inked.emplace_back(static_cast<int>(i % width), static_cast<int>(i / width));
    }
  }
  std::vector<TextPlace> places;
  for (const auto& [x, y] : pixels)
  {
    const auto away = [u = std::floor(x), v = std::floor(y)](const std::pair<int, int>& pixel)
    { return (pixel.first - u) * (pixel.first - u) + (pixel.second - v) * (pixel.second - v); };
    const auto nearest = std::min_element(
      inked.begin(), inked.end(), [&](const auto& a, const auto& b) { return away(a) < away(b); });
    const auto at = nearest == inked.end() ? 0
                                           : static_cast<std::size_t>(nearest->second) *
                                                 static_cast<std::size_t>(drawn.Width) +
                                               static_cast<std::size_t>(nearest->first);
    places.push_back(inked.empty() ? TextPlace() : placeOf[static_cast<std::size_t>(labels[at])]);
  }
  return places;
}

Picture SpreadLetters(const Picture& text, double gap)
{
  std::vector<Letter> parts;
  const std::vector<int> labels = LabelInk(text, parts);
  const std::vector<Letter> letters = JoinParts(parts);
  std::vector<int> letterOf(parts.size(), 0);
  for (std::size_t l = 0; l < letters.size(); ++l)
  {
    for (const int label : letters[l].Labels)
    {
      letterOf[static_cast<std::size_t>(label)] = static_cast<int>(l);
    }
  }
  // The first and last ink of each letter in each row.
  const auto rows = static_cast<std::size_t>(text.Height);
  std::vector<std::vector<int>> first(letters.size(), std::vector<int>(rows, text.Width * 8));
  std::vector<std::vector<int>> last(letters.size(), std::vector<int>(rows, -text.Width * 8));
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= 0)
    {
      const auto l = static_cast<std::size_t>(letterOf[static_cast<std::size_t>(labels[i])]);
      const std::size_t y = i / static_cast<std::size_t>(text.Width);
      const auto x = static_cast<int>(i % static_cast<std::size_t>(text.Width));
      first[l][y] = std::min(first[l][y], x);
      last[l][y] = std::max(last[l][y], x);
    }
  }
  std::vector<int> shifts(letters.size(), 0);
  const int reach = static_cast<int>(gap);
  for (std::size_t l = 1; l < letters.size(); ++l)
  {
    int room = text.Width * 8;
    for (int y = 0; y < text.Height; ++y)
    {
      for (int v = std::max(0, y - reach); v <= std::min(text.Height - 1, y + reach); ++v)
      {
        room = std::min(room, first[l][static_cast<std::size_t>(v)] -
                                last[l - 1][static_cast<std::size_t>(y)] - 1);
      }
    }
    shifts[l] = shifts[l - 1] + std::max(0, static_cast<int>(std::ceil(gap)) - room);
  }
  Picture spread;
  spread.Width = text.Width + (shifts.empty() ? 0 : shifts.back());
  spread.Height = text.Height;
  spread.Pixels.assign(static_cast<std::size_t>(spread.Width) * rows, { 0.f, 0.f, 0.f, 0.f });
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    if (labels[i] >= 0)
    {
      const int l = letterOf[static_cast<std::size_t>(labels[i])];
      const std::size_t y = i / static_cast<std::size_t>(text.Width);
      const std::size_t x =
        i % static_cast<std::size_t>(text.Width) + static_cast<std::size_t>(shifts[l]);
      spread.Pixels[y * static_cast<std::size_t>(spread.Width) + x] = text.Pixels[i];
    }
  }
  return spread;
}

} // namespace waft
