#pragma once

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace slamot::test
{
namespace detail
{
inline void collectTexts(const boost::property_tree::ptree& node, std::vector<std::string>& texts)
{
  for (const auto& [name, child] : node)
  {
    std::string text = child.data();
    while (!text.empty() && text.front() == ' ') text.erase(0, 1);
    if (name == "text" || name == "tspan")
      if (!text.empty()) texts.push_back(text);
    collectTexts(child, texts);
  }
}
}  // namespace detail

/// The words in an SVG.  \throws if it is not well-formed XML.
inline std::vector<std::string> xmlTexts(const std::string& xml)
{
  std::istringstream in(xml);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(in, tree);
  std::vector<std::string> texts;
  detail::collectTexts(tree, texts);
  return texts;
}
}  // namespace slamot::test
