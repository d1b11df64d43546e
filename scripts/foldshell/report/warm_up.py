"""Templates of pages and sheets and the readers of pictures, got ready at import.

The fork server imports this once: its jobs find the templates compiled, a tenth of a second a page.
"""

from PIL import Image

from foldshell.report.markup import templates

for name in templates().list_templates(extensions=["html", "svg"]):
    templates().get_template(name)
Image.init()
