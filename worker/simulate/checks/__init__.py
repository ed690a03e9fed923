"""The measurements of settled cables, and the decision whether a scene may be shipped."""
